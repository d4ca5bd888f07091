#pragma once

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

#include <array>
#include <string>
#include <vector>

// Functions that build scenes in code. The surfaces, objects and materials they return are
// complete.
//
//     Scene scene = make_scene(Illumination::whitted);
//     Material glass = make_material(Illumination::whitted);
//     std::get<WhittedMaterial>(glass.model).transmissive = Rgb(0.9);
//     Object lens = make_object(ellipsoid(), glass);
//     scene.objects.push_back(translate(scale(lens, {1, 1, 0.3}), {0, 0, 5}));
//     validate(scene);   // render() and RayScene also call it
//
// Lengths are in scene units, angles in degrees. validate() checks numbers; these functions do not.
namespace packtrace {

/// The scene that an empty scene file with this illumination describes. Each note has its own
/// defaults.
[[nodiscard]] PACKTRACE_API Scene make_scene(Illumination illumination = Illumination::scratch);

/// The default material of an object under this illumination. `model` holds the alternative that
/// the illumination needs.
[[nodiscard]] PACKTRACE_API Material make_material(Illumination illumination,
                                                   const std::string& name = "");

[[nodiscard]] PACKTRACE_API Sphere sphere(const Vec3& center, double radius);

/// `normal` may have any length except 0. The axes of a checker are set by plane_axes().
[[nodiscard]] PACKTRACE_API Plane plane(const Vec3& point, const Vec3& normal);

// The quadrics of QuadricKind, centred at the origin, with z as their axis. They are not clipped.
[[nodiscard]] PACKTRACE_API Quadric ellipsoid();
[[nodiscard]] PACKTRACE_API Quadric cylinder();
[[nodiscard]] PACKTRACE_API Quadric cone();
[[nodiscard]] PACKTRACE_API Quadric paraboloid();
[[nodiscard]] PACKTRACE_API Quadric hyperboloid();
[[nodiscard]] PACKTRACE_API Quadric hyperboloid2();
[[nodiscard]] PACKTRACE_API Quadric saddle();

/// `coefficients` are A … J of Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy + Iz + J = 0.
[[nodiscard]] PACKTRACE_API Quadric quadric(const std::array<double, 10>& coefficients);

/// A quadric of any kind. For `general`, which has no fixed equation, all coefficients stay 0.
[[nodiscard]] PACKTRACE_API Quadric quadric(QuadricKind kind);

/// The part of a quadric with `low` <= z <= `high` in its own space. clip() leaves the ends open,
/// clip_and_cap() closes them.
[[nodiscard]] PACKTRACE_API Quadric clip(Quadric quadric, double low, double high);
[[nodiscard]] PACKTRACE_API Quadric clip_and_cap(Quadric quadric, double low, double high);

/// A polygon with one contour. For holes, append further contours to `contours`.
[[nodiscard]] PACKTRACE_API Polygon polygon(std::vector<Vec3> corners);

[[nodiscard]] PACKTRACE_API Object make_object(Surface surface, Material material = {},
                                               std::string name = "");

// Each returns the object with one more transformation, applied after its present transform, as
// the keys of a scene file are.
[[nodiscard]] PACKTRACE_API Object translate(Object object, const Vec3& by);
/// Rotates about an axis through the origin, which may have any length except 0. 90 degrees about z
/// take x to y.
/// Throws std::invalid_argument for the axis (0, 0, 0).
[[nodiscard]] PACKTRACE_API Object rotate(Object object, const Vec3& axis, double degrees);
/// Scales about the origin. Negative factors mirror; validate() rejects 0.
[[nodiscard]] PACKTRACE_API Object scale(Object object, const Vec3& factors);
[[nodiscard]] PACKTRACE_API Object scale(Object object, double factor);
[[nodiscard]] PACKTRACE_API Object transform(Object object, const Mat4& matrix);

[[nodiscard]] PACKTRACE_API Light ambient_light(const Rgb& intensity);
[[nodiscard]] PACKTRACE_API Light point_light(const Vec3& position, const Rgb& intensity);
/// `towards` points from the scene to the light.
[[nodiscard]] PACKTRACE_API Light directional_light(const Vec3& towards, const Rgb& intensity);

}  // namespace packtrace
