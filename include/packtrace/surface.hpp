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
    /// Unit axes in the plane that a checker is laid along, those of `plane_axes`; without a
    /// checker they don't count.
    Vec3 u{1.0, 0.0, 0.0};
    Vec3 v{0.0, 0.0, 1.0};

    /// The axes follow from the normal.
    bool operator==(const Plane& other) const
    {
        return point == other.point && normal == other.normal;
    }
};

/// Fills `u` and `v` of a plane from its unit normal: the two world axes that are not the
/// normal's largest component, in x, y, z order, projected into the plane and made
/// orthonormal. The floor y = const gets u = x, v = z.
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
    /// A … J in the order of the equation above; filled in for every kind, with those of its
    /// equation: see ellipsoid() and the others in build.hpp.
    std::array<double, 10> coefficients{};
    /// Keeps only the part with z in this range, in the quadric's own space.
    std::optional<ZRange> z_range = {};
    /// Closes the clipped ends with the flat pieces of inside (F <= 0) at z = low and z = high.
    bool capped = false;

    bool operator==(const Quadric&) const = default;
};

/// A flat piece of a plane. Its contours are closed from the last corner to the first; what a line
/// from it crosses an odd number of times is inside, so that a contour in another one is a hole.
struct Polygon {
    /// At least one contour, each of three corners or more; all corners in one plane.
    std::vector<std::vector<Vec3>> contours;

    bool operator==(const Polygon&) const = default;
};

/// The unit normal of a polygon's plane by Newell's method over the first contour, whose corners
/// run clockwise seen from the side that it points to. Zero where the contour encloses no area.
[[nodiscard]] PACKTRACE_API Vec3 polygon_normal(const Polygon& polygon);

/// What is wrong with a polygon, to be read behind its name: too few corners, no area, not flat.
[[nodiscard]] PACKTRACE_API std::optional<std::string> polygon_fault(const Polygon& polygon);

/// What is wrong with a quadric of kind `general` under its object's transform: its equation has no
/// surface, or its center or axes are beyond single precision.
[[nodiscard]] PACKTRACE_API std::optional<std::string> quadric_fault(const Quadric& quadric,
                                                                     const Mat4& transform);

using Surface = std::variant<Sphere, Plane, Quadric, Polygon>;

}  // namespace packtrace
