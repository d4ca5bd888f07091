#include "lab/stress/placed_quadric.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace packtrace::lab {

Vec3 own_surface_point(StressRandom& random, QuadricKind kind)
{
    if (kind == QuadricKind::ellipsoid)
        return random.unit();
    const double turn = random.between(0.0, 2.0 * std::numbers::pi);
    const double z = random.between(-2.0, 2.0);
    if (kind == QuadricKind::saddle) {
        const double x = random.between(-1.5, 1.5);
        return {x, 0.5 * z, x * x - 0.25 * z * z};
    }
    double height = z;
    double radius = 1.0;
    if (kind == QuadricKind::cone)
        radius = std::abs(z);
    if (kind == QuadricKind::paraboloid)
        radius = std::sqrt(height = std::abs(z));
    if (kind == QuadricKind::hyperboloid)
        radius = std::sqrt(1.0 + z * z);
    if (kind == QuadricKind::hyperboloid2) {
        radius = std::abs(z);
        height = std::copysign(std::sqrt(1.0 + z * z), z);
    }
    return {radius * std::cos(turn), radius * std::sin(turn), height};
}

Mat4 any_turn(StressRandom& random)
{
    const double angle = random.angle();
    return glm::rotate(Mat4(1.0), angle, random.unit());
}

Mat4 any_placement(StressRandom& random, const Vec3& stretch, const Vec3& to)
{
    const Mat4 after = any_turn(random);
    const Mat4 before = any_turn(random);
    return glm::translate(Mat4(1.0), to) * after * glm::scale(Mat4(1.0), stretch) * before;
}

Mat4 sometimes_placed(StressRandom& random, double least, double off)
{
    return random.below(2) == 0
               ? Mat4(1.0)
               : any_placement(random, any_stretch(random, least), random.box(off));
}

Vec3 to_world(const Mat4& m, const Vec3& own)
{
    return Vec3(m * glm::dvec4(own, 1.0));
}

StressCase placed(const Quadric& quadric, const Mat4& transform,
                  std::function<StressRay(StressRandom&)> own_ray)
{
    StressCase result;
    result.scene.objects = {Object{.surface = quadric, .transform = transform}};
    result.scene.camera.position = Vec3(transform[3]) + Vec3(0.0, 0.0, -5.0);
    result.ray = [=, own_ray = std::move(own_ray)](StressRandom& random) {
        const StressRay own = own_ray(random);
        StressRay ray = own;
        ray.org = to_world(transform, own.org);
        ray.dir = glm::normalize(Vec3(transform * glm::dvec4(own.dir, 0.0)));
        return ray;
    };
    return result;
}

Vec3 any_stretch(StressRandom& random, double least)
{
    const double x = random.power(least, 1.0);
    const double y = random.power(least, 1.0);
    const double z = random.power(least, 1.0);
    return {x, y, z};
}

}  // namespace packtrace::lab
