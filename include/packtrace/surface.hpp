#pragma once

#include <packtrace/export.hpp>
#include <packtrace/vec.hpp>

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace packtrace {

struct Sphere {
    Vec3 center{0.0};
    double radius = 1.0;  ///< scene units, > 0

    bool operator==(const Sphere&) const = default;
};

struct Plane {
    Vec3 point{0.0};
    Vec3 normal{0.0, 1.0, 0.0};  ///< unit, within 1e-6
    /// The checker's unit axes in the plane, as plane_axes() sets them. Unused without a checker.
    Vec3 u{1.0, 0.0, 0.0};
    Vec3 v{0.0, 0.0, 1.0};

    /// Ignores the axes, because they follow from the normal.
    bool operator==(const Plane& other) const
    {
        return point == other.point && normal == other.normal;
    }
};

/// Sets `u` and `v` of a plane from its unit normal. They are the two world axes other than that of
/// the normal's largest component, in x, y, z order, projected into the plane and made orthonormal.
/// The floor y = const gets u = x, v = z.
PACKTRACE_API void plane_axes(Plane& plane);

enum class QuadricKind {
    ellipsoid,     ///< x² + y² + z² = 1
    cylinder,      ///< x² + y² = 1
    cone,          ///< x² + y² = z²
    paraboloid,    ///< x² + y² = z
    hyperboloid,   ///< x² + y² - z² = 1, one sheet
    hyperboloid2,  ///< x² + y² - z² = -1, two sheets
    saddle,        ///< x² - y² = z
    general        ///< `coefficients`
};

struct ZRange {
    double low = 0.0;
    double high = 0.0;  ///< > low

    bool operator==(const ZRange&) const = default;
};

/// Ax² + By² + Cz² + Dxy + Exz + Fyz + Gx + Hy + Iz + J = 0 in its own space.
struct Quadric {
    QuadricKind kind = QuadricKind::general;
    /// A … J in the order of the equation above, also for kinds other than `general`: they have the
    /// coefficients of the kind's equation. See ellipsoid() and the others in build.hpp.
    std::array<double, 10> coefficients{};
    /// Clips the surface to z in this range, in the quadric's own space.
    std::optional<ZRange> z_range = {};
    /// Closes the clipped ends with the parts of the planes z = low and z = high that are inside
    /// the quadric (F <= 0).
    bool capped = false;

    bool operator==(const Quadric&) const = default;
};

/// A flat piece of a plane. Contours are closed from the last corner to the first. A point is
/// inside if a half-line from it crosses the contours an odd number of times, so a contour inside
/// another one is a hole.
struct Polygon {
    /// At least one contour, each with three or more corners; all corners in one plane.
    std::vector<std::vector<Vec3>> contours;

    bool operator==(const Polygon&) const = default;
};

/// The unit normal of a polygon's plane, by Newell's method over the first contour. Seen from the
/// side that the normal points to, the corners run clockwise. Zero if the contour has no area.
[[nodiscard]] PACKTRACE_API Vec3 polygon_normal(const Polygon& polygon);

/// What is wrong with a polygon, as a text to follow its name: too few corners, no area, not flat.
/// Not set for a valid polygon.
[[nodiscard]] PACKTRACE_API std::optional<std::string> polygon_fault(const Polygon& polygon);

/// What is wrong with a quadric of kind `general` under its object's transform: its equation has no
/// surface, or its centre or axes exceed single precision. Not set for a valid quadric.
[[nodiscard]] PACKTRACE_API std::optional<std::string> quadric_fault(const Quadric& quadric,
                                                                     const Mat4& transform);

using Surface = std::variant<Sphere, Plane, Quadric, Polygon>;

}  // namespace packtrace
