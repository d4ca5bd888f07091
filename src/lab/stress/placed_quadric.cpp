#include "lab/stress/placed_quadric.hpp"

#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace packtrace::lab {

Mat4 any_turn(StressRandom& random)
{
    const double angle = random.between(0.0, 6.2831853);
    return glm::rotate(Mat4(1.0), angle, random.unit());
}

Mat4 any_placement(StressRandom& random, const Vec3& stretch, const Vec3& to)
{
    const Mat4 after = any_turn(random);
    const Mat4 before = any_turn(random);
    return glm::translate(Mat4(1.0), to) * after * glm::scale(Mat4(1.0), stretch) * before;
}

Vec3 to_world(const Mat4& m, const Vec3& own)
{
    return Vec3(m * glm::dvec4(own, 1.0));
}

StressCase placed(const Quadric& quadric, const Mat4& transform,
                  std::function<StressRay(StressRandom&)> own_ray)
{
    StressCase result;
    Object object;
    object.surface = quadric;
    object.transform = transform;
    result.scene.objects = {object};
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
