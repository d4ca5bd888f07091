#include "lab/stress/stress_family.hpp"

#include <glm/geometric.hpp>

#include <iterator>
#include <limits>
#include <variant>

namespace packtrace::lab {
namespace {

template <class Real>
void round(double& x)
{
    x = static_cast<double>(static_cast<Real>(x));
}

template <class Real>
void round(Vec3& v)
{
    for (int axis = 0; axis < 3; ++axis)
        round<Real>(v[axis]);
}

// A plane's normal and a quadric's coefficients are not rounded.
template <class Real>
void round(Sphere& sphere)
{
    round<Real>(sphere.center);
    round<Real>(sphere.radius);
}
template <class Real>
void round(Plane& plane)
{
    round<Real>(plane.point);
}
template <class Real>
void round(Polygon& polygon)
{
    for (auto& contour : polygon.contours)
        for (Vec3& corner : contour)
            round<Real>(corner);
}
template <class Real>
void round(Quadric&)
{
}

}  // namespace

const std::vector<StressFamily>& stress_families()
{
    static const std::vector<StressFamily> families = [] {
        std::vector<StressFamily> all;
        for (auto some : {sphere_families(), plane_families(), quadric_families(), scene_families(),
                          far_families(), touching_families(), edge_families(), polygon_families(),
                          mixed_families()})
            all.insert(all.end(), std::move_iterator(some.begin()), std::move_iterator(some.end()));
        return all;
    }();
    return families;
}

StressRay ray_towards(const Vec3& org, const Vec3& target)
{
    return {org, target - org, 0.0, std::numeric_limits<double>::infinity()};
}

Object sphere_object(const Vec3& center, double radius)
{
    return {.surface = Sphere{center, radius}};
}

Object plane_object(const Vec3& point, const Vec3& normal)
{
    Plane plane{.point = point, .normal = normal};
    plane_axes(plane);
    return {.surface = plane};
}

StressCase case_of(std::vector<Object> objects, std::function<StressRay(StressRandom&)> ray)
{
    StressCase result;
    result.scene.objects = std::move(objects);
    result.ray = std::move(ray);
    return result;
}

StressCase known_case(std::vector<Object> objects, const StressRay& ray)
{
    return case_of(std::move(objects), [ray, first = true](StressRandom& random) mutable {
        StressRay next = ray;
        if (!first)
            for (int axis = 0; axis < 3; ++axis) {
                next.org[axis] *= 1.0 + random.between(-1.0, 1.0) * 0x1p-21;
                next.dir[axis] *= 1.0 + random.between(-1.0, 1.0) * 0x1p-21;
            }
        first = false;
        return next;
    });
}

Vec3 across(StressRandom& random, const Vec3& v)
{
    return glm::normalize(glm::cross(v, random.unit() + 1e-3 * Vec3(v.y, v.z, v.x)));
}

template <class Real>
void round_to_precision(Scene& scene)
{
    for (Object& object : scene.objects) {
        std::visit([](auto& surface) { round<Real>(surface); }, object.surface);
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row)
                round<Real>(object.transform[column][row]);
    }
}

template <class Real>
void round_to_precision(StressRay& ray)
{
    round<Real>(ray.org);
    round<Real>(ray.dir);
    round<Real>(ray.t_min);
    round<Real>(ray.t_max);
}

template void round_to_precision<float>(Scene&);
template void round_to_precision<double>(Scene&);
template void round_to_precision<float>(StressRay&);
template void round_to_precision<double>(StressRay&);

}  // namespace packtrace::lab
