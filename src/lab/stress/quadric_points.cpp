#include "lab/stress/quadric_points.hpp"

#include <stdexcept>

#include "scene/quadric_kinds.hpp"

namespace packtrace::lab {

Quadric quadric_of(QuadricKind kind)
{
    const QuadricKindInfo* const info = find_quadric_kind(kind);
    if (info == nullptr)
        throw std::invalid_argument("a general quadric has coefficients of its own");
    Quadric quadric;
    quadric.kind = kind;
    quadric.coefficients = info->coefficients;
    return quadric;
}

Vec3 own_surface_point(StressRandom& random, QuadricKind kind)
{
    if (kind == QuadricKind::ellipsoid)
        return random.unit();
    const double turn = random.between(0.0, 6.2831853071795862);
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

}  // namespace packtrace::lab
