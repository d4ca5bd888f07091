#pragma once

#include <cstdint>
#include <optional>
#include <tuple>

#include <packtrace/vec.hpp>

// What every kind of surface answers with, and what they share in finding it.
namespace packtrace {

/// Where a line from inside leaves again, as a t; nothing from outside.
using Exit = std::optional<double>;

/// A box around a surface in world space, of infinite size around one without bounds.
struct CenteredBox {
    Vec3 center{0.0};
    Vec3 half{0.0};  ///< of its sizes
};

/// The first root above 0 of a t² + 2 b t + c; infinite where there is none.
[[nodiscard]] double first_positive_root(double a, double b, double c);

/// Whether error bounds in single precision hold for the magnitudes of a ball
/// (kernels/geometry/error_bounds.hpp).
[[nodiscard]] bool is_certifiable(const Vec3& center, double radius);

/// Whether single precision reckons with all of a box; not with one at NaN.
[[nodiscard]] bool within_tree(const CenteredBox& box);

[[nodiscard]] inline auto key_of(const Vec3& v)
{
    return std::tuple(v.x, v.y, v.z);
}

}  // namespace packtrace
