#pragma once

#include "catch.hpp"
#include "reference/reference.hpp"
#include <packtrace/scene.hpp>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

// Small scenes for the tests of the scalar reference.
namespace packtrace::test {

inline Object sphere(const Vec3& center, double radius, const Material& material = {})
{
    return {.surface = Sphere{center, radius}, .material = material};
}

inline Object plane(const Vec3& point, const Vec3& normal, const Material& material = {})
{
    Plane surface{.point = point, .normal = glm::normalize(normal)};
    plane_axes(surface);
    return {.surface = surface, .material = material};
}

/// A scratch material without a highlight.
inline Material matte(const Rgb& color, double reflective = 0.0)
{
    Material material;
    material.color = color;
    material.model = ScratchMaterial{-1.0, reflective};
    return material;
}

/// A quadric with coefficients A … J, in object space.
inline Object quadric(const std::array<double, 10>& coefficients, const Material& material = {})
{
    return {.surface = Quadric{.coefficients = coefficients}, .material = material};
}

/// A white material of another model.
template <class Model>
Material shaded(const Model& model, const Rgb& color = Rgb(1))
{
    Material material;
    material.color = color;
    material.model = model;
    return material;
}

inline Light ambient(double intensity)
{
    return {LightType::ambient, Rgb(intensity), Vec3(0.0)};
}

inline Light point_light(const Vec3& position, double intensity)
{
    return {LightType::point, Rgb(intensity), position};
}

inline Light directional(const Vec3& direction, double intensity)
{
    return {LightType::directional, Rgb(intensity), direction};
}

/// The colour of a camera ray along `dir`, in double precision.
inline reference::Vec3<double> trace(const Scene& scene, const reference::Vec3<double>& org,
                                     const reference::Vec3<double>& dir)
{
    return reference::Reference<double>(scene).trace_ray(org, dir);
}

/// The colour of a ray that hits the floor y = 0 at the origin.
inline reference::Vec3<double> seen(const Scene& scene)
{
    return trace(scene, {-3, 4, 0}, {3, -4, 0});
}

template <class Real>
void check_color(const reference::Color<Real>& got, const Rgb& expected, double margin = 1e-12)
{
    CAPTURE(static_cast<double>(got.x), static_cast<double>(got.y), static_cast<double>(got.z));
    CHECK(std::abs(static_cast<double>(got.x) - expected.x) <= margin);
    CHECK(std::abs(static_cast<double>(got.y) - expected.y) <= margin);
    CHECK(std::abs(static_cast<double>(got.z) - expected.z) <= margin);
}

}  // namespace packtrace::test
