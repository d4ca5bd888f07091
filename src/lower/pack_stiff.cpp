#include "lower/pack_stiff.hpp"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "lower/pack_record.hpp"

namespace packtrace {
namespace {

constexpr double single_roundoff = 0x1p-24;

float rounded_up(double x)
{
    return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

/// Margins as docs/numerics.md proves them.
void set_bound(abi::StiffObject& packed, const Vec3& center, double radius)
{
    round_to(packed.bound, center);
    const double off = single_roundoff * glm::length(center);
    packed.bound_radius = rounded_up(radius + 2.0 * off);
    packed.bound_radius2 = rounded_up((1.0 + 32.0 * single_roundoff) * radius * radius +
                                      4.0 * single_roundoff * glm::dot(center, center));
}

abi::StiffObject unbounded(abi::StiffKind kind, std::int32_t surface)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    abi::StiffObject packed{};
    packed.kind = kind;
    packed.surface = surface;
    packed.bound_radius = infinity;
    packed.bound_radius2 = infinity;
    return packed;
}

}  // namespace

abi::StiffObject pack_stiff_object(const LoweredHugeSphere& sphere)
{
    abi::StiffObject packed = unbounded(abi::StiffKind::huge_sphere, sphere.surface);
    packed.huge = pack_huge<double>(sphere);
    return packed;
}

abi::StiffObject pack_stiff_object(const LoweredSphere& sphere)
{
    abi::StiffObject packed = unbounded(abi::StiffKind::sphere, sphere.surface);
    round_to(packed.sphere.center, sphere.center);
    packed.sphere.radius2 = sphere.radius * sphere.radius;
    set_bound(packed, sphere.center, sphere.radius);
    return packed;
}

abi::StiffObject pack_stiff_object(const LoweredPlane& plane)
{
    abi::StiffObject packed = unbounded(abi::StiffKind::plane, plane.surface);
    packed.plane = pack_plane<double>(plane);
    return packed;
}

abi::StiffObject pack_stiff_object(const LoweredQuadric& quadric)
{
    abi::StiffObject packed = unbounded(abi::StiffKind::quadric, quadric.surface);
    packed.quadric = pack_quadric<double>(quadric);
    if (std::isfinite(quadric.bound_radius))
        set_bound(packed, quadric.bound, quadric.bound_radius);
    return packed;
}

}  // namespace packtrace
