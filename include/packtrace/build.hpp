#pragma once

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

#include <array>
#include <string>
#include <vector>

// Scenes built in code: surfaces, objects and materials that are complete from the start.
//
//     Scene scene = make_scene(Illumination::whitted);
//     Material glass = make_material(Illumination::whitted);
//     std::get<WhittedMaterial>(glass.model).transmissive = Rgb(0.9);
//     Object lens = make_object(ellipsoid(), glass);
//     scene.objects.push_back(translate(scale(lens, {1, 1, 0.3}), {0, 0, 5}));
//     validate(scene);   // render() and RayScene do so themselves
//
// Lengths are in scene units, angles in degrees. Numbers are checked by validate(), not here.
namespace packtrace {

/// A scene as an empty file with this illumination describes it, each note with its own defaults.
[[nodiscard]] PACKTRACE_API Scene make_scene(Illumination illumination = Illumination::scratch);

/// The material of an object that says nothing of it under this illumination: `model` holds the
/// alternative that the illumination needs.
[[nodiscard]] PACKTRACE_API Material make_material(Illumination illumination,
                                                   const std::string& name = "");

[[nodiscard]] PACKTRACE_API Sphere sphere(const Vec3& center, double radius);

/// `normal` may have any length but 0; the checker's axes are laid.
[[nodiscard]] PACKTRACE_API Plane plane(const Vec3& point, const Vec3& normal);

// The quadrics of QuadricKind, about the origin and the z axis, unbounded where their equation is.
[[nodiscard]] PACKTRACE_API Quadric ellipsoid();
[[nodiscard]] PACKTRACE_API Quadric cylinder();
[[nodiscard]] PACKTRACE_API Quadric cone();
[[nodiscard]] PACKTRACE_API Quadric paraboloid();
[[nodiscard]] PACKTRACE_API Quadric hyperboloid();
[[nodiscard]] PACKTRACE_API Quadric hyperboloid2();
[[nodiscard]] PACKTRACE_API Quadric saddle();

/// A … J of Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy + Iz + J = 0.
[[nodiscard]] PACKTRACE_API Quadric quadric(const std::array<double, 10>& coefficients);

/// A quadric of any kind but `general`, which has no coefficients of its own and stays without.
[[nodiscard]] PACKTRACE_API Quadric quadric(QuadricKind kind);

/// The part of a quadric between two heights z in its own space, open at its ends or closed.
[[nodiscard]] PACKTRACE_API Quadric clip(Quadric quadric, double low, double high);
[[nodiscard]] PACKTRACE_API Quadric clip_and_cap(Quadric quadric, double low, double high);

/// A polygon of one contour; push_back further ones to `contours` for holes.
[[nodiscard]] PACKTRACE_API Polygon polygon(std::vector<Vec3> corners);

[[nodiscard]] PACKTRACE_API Object make_object(Surface surface, Material material = {},
                                               std::string name = "");

// The object moved further: each is applied after what its transform has done so far, as the keys
// of a scene file are.
[[nodiscard]] PACKTRACE_API Object translate(Object object, const Vec3& by);
/// By `degrees` about an axis through the origin, of any length but 0: 90 about z take x to y.
/// Throws std::invalid_argument for the axis (0, 0, 0).
[[nodiscard]] PACKTRACE_API Object rotate(Object object, const Vec3& axis, double degrees);
/// About the origin; factors below 0 mirror, 0 is refused by validate().
[[nodiscard]] PACKTRACE_API Object scale(Object object, const Vec3& factors);
[[nodiscard]] PACKTRACE_API Object scale(Object object, double factor);
[[nodiscard]] PACKTRACE_API Object transform(Object object, const Mat4& matrix);

[[nodiscard]] PACKTRACE_API Light ambient_light(const Rgb& intensity);
[[nodiscard]] PACKTRACE_API Light point_light(const Vec3& position, const Rgb& intensity);
/// `towards` points from the scene to the light.
[[nodiscard]] PACKTRACE_API Light directional_light(const Vec3& towards, const Rgb& intensity);

}  // namespace packtrace
