#pragma once

#include "kernels/shade/lighting.hpp"
#include "kernels/shade/shade_context.hpp"

// Whether a point is in the shadow of the object that it lies on. No occluder is searched for: the
// t at which the shadow segment hits that object again decides.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The lanes whose segment to the light leaves the surface on the outer side. The N·L of shading
/// decides, and no other product, which might round to the other side where the light grazes the
/// surface.
template <class Real>
inline std::uint32_t outside_towards(const SurfacePacket<Real>& surface,
                                     const Vec3v<Real>& to_light)
{
    const vreal<Real> zero(Real(0));
    const vreal<Real> normal_light = dot(surface.normal, to_light);
    return ~((bits(normal_light < zero) & ~surface.turned) |
             (bits(normal_light > zero) & surface.turned));
}

/// The t at which the segment from a point to a light ends.
template <class Real>
inline Real way_end(const abi::LightRecord<Real>& light)
{
    return light.kind == abi::LightKind::directional ? static_cast<Real>(__builtin_inf()) : Real(1);
}

/// The height of a point over one surface of an object.
template <class Shape>
inline double height_of_place(const Shape& shape, unsigned piece, const Vec3v<double>& place)
{
    return first_lane<double>(height_over(shape, piece, place));
}

/// Whether a point is outside the object that a surface belongs to: for a capped quadric, over any
/// of its surfaces.
template <class Shape>
inline bool is_outside(const Shape& shape, unsigned piece, const Vec3v<double>& place)
{
    if constexpr (requires { shape.capped; })
        if (shape.capped)
            return height_of_place(shape, 0, place) > 0 || height_of_place(shape, 1, place) > 0 ||
                   height_of_place(shape, 2, place) > 0;
    return height_of_place(shape, piece, place) > 0;
}

/// If the object's hit is within this share of the segment of the light, rounding may decide which
/// comes first: for segments along a surface, both terms of t cancel.
inline constexpr double ends_at_light = 0x1p-12;

/// Lanes of a packet for which past_gap() is true of the object's side.
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

/// For segments that hit their own object again close to the light (`near`): the lanes whose hit is
/// before the light. A segment from inside is occluded if the light is outside, and one from
/// outside if the light is inside. A light on the surface is neither. If the segment has two more
/// hits, through a gap, the light may be inside again.
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

/// Lanes of `wanted` in the shadow of their own object, with SelfHits::exact.
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
