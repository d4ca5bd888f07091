#pragma once

#include "kernels/filter.hpp"
#include "kernels/gradient.hpp"
#include "kernels/own_surface.hpp"
#include "kernels/records.hpp"
#include "kernels/widen.hpp"

// How rays leave the surface they start on. One root of its equation along such a ray is known to
// be 0, so that it is not looked for, and the constant is 0 whatever rounding makes of it: the
// other root is -2 slope / bend, for every kind of surface. It is found once, when the ray is made,
// in double; the search passes over the surface. Of other surfaces rays keep off by what rounding
// does to the place they start at.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// What a packet of rays starts on.
template <class Real>
struct StartPacket {
    Vec3v<Real> point;
    vint<Real> surface;  ///< -1: none
    vreal<Real> second;  ///< where the ray meets that surface again; infinite for nowhere
};

template <class Real>
inline StartPacket<Real> no_start()
{
    const vreal<Real> zero(Real(0));
    return {{zero, zero, zero},
            vint<Real>(lane_int<Real>(-1)),
            vreal<Real>(static_cast<Real>(__builtin_inf()))};
}

/// What a search that passes over the own surface has found before it begins.
template <class Real>
inline HitPacket<Real> start_of_search(const StartPacket<Real>& start, const vreal<Real>& t_max)
{
    const vreal<Real> never(static_cast<Real>(__builtin_inf()));
    const auto again = start.second < t_max;
    HitPacket<Real> hit;
    hit.t = hit.t_low = t_max;
    hit.other = never;
    hit.surface = select(again, start.surface, no_surface<Real>());
    if constexpr (sizeof(Real) == sizeof(float)) {
        hit.t = select(again, rounded_high(start.second), t_max);
        hit.t_low = select(again, rounded_low(start.second), t_max);
    } else {
        hit.t = select(again, start.second, t_max);
    }
    return hit;
}

/// A surface along lines from a point on it: 2 slope t + bend t² = 0.
struct SurfaceLine {
    vreal<double> slope, bend;
};

/// Whether a surface may be met again from its inner side alone, from anywhere, or never.
enum class HitAgain { never, from_inside, from_anywhere };

inline HitAgain hit_again(const abi::ShapesView& shapes, const abi::SurfaceIndex& index)
{
    switch (index.kind) {
        case abi::SurfaceKind::sphere:
        case abi::SurfaceKind::anchored_sphere:
            return HitAgain::from_inside;
        case abi::SurfaceKind::quadric_side: {
            const double(&s)[3] = shapes.quadrics[index.record].square;
            return s[0] >= 0 && s[1] >= 0 && s[2] >= 0 ? HitAgain::from_inside
                                                       : HitAgain::from_anywhere;
        }
        default:
            return HitAgain::never;
    }
}

/// The other root of `line`, whose slope has the sign of the side that the rays leave on, so that
/// rounding cannot turn it for grazing rays.
inline vreal<double> other_root(const SurfaceLine& line, vmask<double> outside)
{
    const vreal<double> never(__builtin_inf());
    const vreal<double> twice = abs(line.slope) + abs(line.slope);
    const vreal<double> t = select(outside, negated(twice), twice) / line.bend;
    return select((t > vreal<double>(0.0)) & (t < never), t, never);
}

inline vreal<double> other_root(const abi::SphereShape& sphere, const Vec3v<double>& point,
                                const Vec3v<double>& dir, vmask<double> outside)
{
    return other_root({dot(point - broadcast(sphere.center), dir), dot(dir, dir)}, outside);
}

inline vreal<double> other_root(const abi::AnchoredSphere<double>& sphere,
                                const Vec3v<double>& point, const Vec3v<double>& dir,
                                vmask<double> outside)
{
    return other_root({dot(normal_at<double>(sphere, point), dir),
                       vreal<double>(sphere.curvature) * dot(dir, dir)},
                      outside);
}

inline vreal<double> other_root(const abi::QuadricRecord<double>& quadric,
                                const Vec3v<double>& point, const Vec3v<double>& dir,
                                vmask<double> outside)
{
    const auto [p, height] = quadric_origin<double>(quadric, point);
    const Vec3v<double> v = apply_inverse(quadric, dir);
    const Vec3v<double> scaled = broadcast(quadric.square) * v;
    const vreal<double> slope = madd(vreal<double>(quadric.linear), v.z, dot(scaled, p));
    const vreal<double> t = other_root({slope, dot(scaled, v)}, outside);
    if (!quadric.clipped)
        return t;
    const LineInterval<double> between = clip_crossings<double>(quadric, height, dir).between;
    return select((t >= between.low) & (t <= between.high), t, vreal<double>(__builtin_inf()));
}

inline vreal<double> other_root(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                                const Vec3v<double>& point, const Vec3v<double>& dir,
                                vmask<double> outside)
{
    if (index.kind == abi::SurfaceKind::sphere)
        return other_root(shapes.spheres[index.record], point, dir, outside);
    if (index.kind == abi::SurfaceKind::anchored_sphere)
        return other_root(shapes.anchored_spheres[index.record], point, dir, outside);
    return other_root(shapes.quadrics[index.record], point, dir, outside);
}

/// The same for a packet of either precision.
inline vreal<double> other_root_of(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                                   const Vec3v<double>& point, const Vec3v<double>& dir,
                                   std::uint32_t outside)
{
    return other_root(shapes, index, point, dir, from_bits<double>(outside & all_lanes<double>));
}
inline vreal<float> other_root_of(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                                  const Vec3v<float>& point, const Vec3v<float>& dir,
                                  std::uint32_t outside)
{
    return narrow(other_root_of(shapes, index, widen_low(point), widen_low(dir), outside),
                  other_root_of(shapes, index, widen_high(point), widen_high(dir),
                                (outside & all_lanes<float>) >> lanes<double>));
}

/// For the lanes of `active`, each from a point of its own surface; `outside` are those that leave
/// it on the outer side.
template <class Real>
[[gnu::noinline]] vreal<Real> look_for_second_root(const abi::ShapesView& shapes,
                                                   const vint<Real>& surface,
                                                   const Vec3v<Real>& point, const Vec3v<Real>& dir,
                                                   std::uint32_t outside, std::uint32_t active)
{
    vreal<Real> t(static_cast<Real>(__builtin_inf()));
    for_each_distinct<Real>(surface, active, [&](lane_int<Real> number, vmask<Real> same) {
        const abi::SurfaceIndex& index = shapes.index[number];
        const HitAgain again = hit_again(shapes, index);
        if (again == HitAgain::never)
            return;
        const std::uint32_t leavers =
            again == HitAgain::from_inside ? bits(same) & ~outside : bits(same);
        if ((leavers & active) != 0)
            t = select(from_bits<Real>(leavers), other_root_of(shapes, index, point, dir, outside),
                       t);
    });
    return t;
}

/// The same, without looking where nothing is met again.
template <class Real>
inline vreal<Real> second_root(const abi::ShapesView& shapes, const vint<Real>& surface,
                               const Vec3v<Real>& point, const Vec3v<Real>& dir,
                               std::uint32_t outside, std::uint32_t active)
{
    const std::uint32_t may_meet = shapes.hit_again_outside ? active : active & ~outside;
    if (may_meet == 0)
        return vreal<Real>(static_cast<Real>(__builtin_inf()));
    return look_for_second_root<Real>(shapes, surface, point, dir, outside, may_meet);
}

/// The sum of |a_i| |b_i|.
template <class Real>
inline vreal<Real> magnitude_dot(const Vec3v<Real>& a, const Vec3v<Real>& b)
{
    return madd(abs(a.x), abs(b.x), madd(abs(a.y), abs(b.y), abs(a.z) * abs(b.z)));
}

/// How much of a point's size counts in its offset where its coordinate across the surface is near
/// 0: points that are refined in double are off by double's roundoffs then.
template <class Real>
inline constexpr Real size_share = sizeof(Real) == sizeof(float) ? Real(0x1p-20) : Real(1);

/// The offset of a ray's origin from its surface, along the outward normal by what rounding can do
/// to a point there (after Pharr, Jakob and Humphreys, Physically Based Rendering, section 6.8).
template <class Real>
inline Vec3v<Real> origin_offset(Real start_error, const Vec3v<Real>& point,
                                 const Vec3v<Real>& outward)
{
    const vreal<Real> size =
        madd(vreal<Real>(size_share<Real>), abs(point.x) + abs(point.y) + abs(point.z),
             magnitude_dot(outward, point));
    return scale<Real>(vreal<Real>(start_error) * size, outward);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
