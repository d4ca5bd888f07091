#pragma once

#include "kernels/shade/lighting.hpp"
#include "kernels/shade/shade_context.hpp"

// Whether the body that a point is on keeps it from a light: not looked for among the others, but
// told by where the way meets that body again.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The lanes from which the way to a light leaves a body on the outer side. The N·L of shading
/// decides, and no other product: one may round to the other side where a light grazes a surface.
template <class Real>
inline std::uint32_t outside_towards(const SurfacePacket<Real>& surface,
                                     const Vec3v<Real>& to_light)
{
    const vreal<Real> zero(Real(0));
    const vreal<Real> normal_light = dot(surface.normal, to_light);
    return ~((bits(normal_light < zero) & ~surface.turned) |
             (bits(normal_light > zero) & surface.turned));
}

/// Where the way from a point to a light ends.
template <class Real>
inline Real way_end(const abi::LightRecord<Real>& light)
{
    return light.kind == abi::LightKind::directional ? static_cast<Real>(__builtin_inf()) : Real(1);
}

/// How far a place is over a piece of a body.
template <class Shape>
inline double height_of_place(const Shape& shape, unsigned piece, const Vec3v<double>& place)
{
    return first_lane<double>(height_over(shape, piece, place));
}

/// Whether a place is outside the body that a piece is of: of one that caps close over any piece.
template <class Shape>
inline bool is_outside(const Shape& shape, unsigned piece, const Vec3v<double>& place)
{
    if constexpr (requires { shape.capped; })
        if (shape.capped)
            return height_of_place(shape, 0, place) > 0 || height_of_place(shape, 1, place) > 0 ||
                   height_of_place(shape, 2, place) > 0;
    return height_of_place(shape, piece, place) > 0;
}

/// The share of a way within which rounding may have the body end before a light, or behind it: of
/// ways along a surface, both terms of the t cancel.
inline constexpr double ends_at_light = 0x1p-12;

/// Lanes of a packet for which past_gap() holds of the body's side.
template <class Real, class Shape>
inline std::uint32_t past_gap_of(const Shape& shape, unsigned piece, const Vec3v<double>& place,
                                 const Vec3v<Real>& way)
{
    if constexpr (requires { past_gap(shape, place, place); }) {
        if (piece != 0)
            return 0;
        if constexpr (sizeof(Real) == sizeof(float))
            return narrow_bits(past_gap(shape, place, widen_low(way)),
                               past_gap(shape, place, widen_high(way)));
        else
            return past_gap(shape, place, way);
    } else {
        return 0;
    }
}

/// Lanes of `near`, whose ways to a light meet their own body again there, or nearly, for which
/// that is before it: outside where they come from inside, or inside. What lies on the body is on
/// neither side. Where the way has two more crossings, through a gap, the light may be inside
/// again.
template <class Real>
[[gnu::noinline]] std::uint32_t behind_own_body(const abi::ShapesView& shapes,
                                                const vint<Real>& surface, const Vec3v<Real>& way,
                                                const abi::LightRecord<Real>& light,
                                                std::uint32_t outside, std::uint32_t near)
{
    const double position[3] = {double{light.vector[0]}, double{light.vector[1]},
                                double{light.vector[2]}};
    const Vec3v<double> place = broadcast(position);
    std::uint32_t behind = 0;
    for_each_distinct<Real>(surface, near, [&](lane_int<Real> number, vmask<Real> same) {
        const std::uint32_t lanes_of = bits(same) & near;
        with_shape(shapes, shapes.index[number], [&](const auto& shape, unsigned piece) {
            if (is_outside(shape, piece, place))
                behind |= lanes_of & ~outside;
            if (height_of_place(shape, piece, place) < 0)
                behind |= lanes_of & (outside | past_gap_of<Real>(shape, piece, place, way));
        });
    });
    return behind;
}

/// Lanes of `wanted` that their own body keeps from a light, by SelfHits::exact.
template <class Real>
inline std::uint32_t own_shadow(const abi::SceneView<Real>& scene,
                                const abi::LightRecord<Real>& light,
                                const LightPacket<Real>& packet, const SurfacePacket<Real>& surface,
                                std::uint32_t wanted)
{
    if (!(scene.rules.start_error > 0))
        return 0;
    const std::uint32_t outside = outside_towards(surface, packet.to_light);
    const abi::ShapesView& shapes = casters_of(scene).shapes;
    const SecondHit<Real> again =
        second_hit<Real>(shapes, surface.number, surface.point, packet.to_light,
                         vreal<Real>(Real(0)), outside, wanted);
    const vreal<Real> end(way_end(light));
    const std::uint32_t before = bits(again.t < end) & wanted;
    if (light.kind == abi::LightKind::directional)
        return before;
    const std::uint32_t near =
        bits(abs(again.t - end) < vreal<Real>(static_cast<Real>(ends_at_light))) & wanted;
    if (near == 0)
        return before;
    return (before & ~near) |
           behind_own_body<Real>(shapes, again.surface, packet.to_light, light, outside, near);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
