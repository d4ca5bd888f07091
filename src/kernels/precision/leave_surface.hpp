#pragma once

#include "kernels/geometry/kinds.hpp"
#include "kernels/precision/own_surface.hpp"
#include "kernels/simd/records.hpp"

// How rays leave the surface that they start on without hitting it at once. One root of the
// surface's equation along such a ray is known to be 0, so it is not searched for, and the
// equation's constant is 0 whatever its rounded value. The other root is -2 slope / bend for every
// kind of surface (one_surface.hpp). When a ray is made, it is found once, in double, where the ray
// hits its own object again; the search then skips all surfaces of that object. To avoid hits with
// other surfaces at the start, the ray's origin is moved off its surface by the rounding error of
// the start point (origin_offset()).
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where rays hit the surface that they start on again, or another surface of the same object.
template <class Real>
struct SecondHit {
    vreal<Real> t;       ///< infinite if they do not
    vint<Real> surface;  ///< the surface that is hit; meaningless if t is infinite
};

/// Where a packet of rays starts.
template <class Real>
struct StartPacket {
    Vec3v<Real> point;
    vint<Real> surface;  ///< -1: on no surface
    SecondHit<Real> second;
};

template <class Real>
inline SecondHit<Real> no_second_hit()
{
    return {vreal<Real>(static_cast<Real>(__builtin_inf())), no_surface<Real>()};
}

template <class Real>
inline StartPacket<Real> no_start()
{
    const vreal<Real> zero(Real(0));
    return {{zero, zero, zero}, no_surface<Real>(), no_second_hit<Real>()};
}

/// If another hit is so close to the hit with the own object, both are compared again
/// (met_again.hpp). Other surfaces are searched for from the offset origin (origin_offset()), which
/// moves their t by the offset over the slope at which the ray meets them.
struct Closeness {
    double of_t;      ///< as a share of t
    double of_start;  ///< as a share of the start's coordinates, in lengths of the ray
};
template <class Real>
inline constexpr Closeness nearly_met = sizeof(Real) == sizeof(float) ? Closeness{0x1p-12, 0x1p-17}
                                                                      : Closeness{0x1p-40, 0x1p-42};

/// The same in t, for rays from `start` that hit their own object at `t`. At most an eighth of t,
/// so that what is compared again lies well beyond the start.
template <class Real>
inline vreal<Real> near_own_hit(const Closeness& share, const vreal<Real>& t,
                                const Vec3v<Real>& start, const vreal<Real>& dir2)
{
    const vreal<Real> of_start = vreal<Real>(static_cast<Real>(share.of_start)) * size_of(start) *
                                 (vreal<Real>(Real(1)) / sqrt(dir2));
    return min(madd(vreal<Real>(static_cast<Real>(share.of_t)), t, of_start),
               vreal<Real>(Real(0.125)) * t);
}

/// The error of the t at which rays hit their own object again, compared with hits of other
/// surfaces: those are searched for from the offset origin (origin_offset()), and t is rounded.
inline vreal<float> met_again_error(const StartPacket<float>& start, const vreal<float>& dir2)
{
    const Vec3v<float>& at = start.point;
    const vreal<float> size = size_of(at);
    return madd(vreal<float>(0x1p-21f) * size, rough_inverse_sqrt(dir2),
                vreal<float>(0x1p-20f) * start.second.t);
}

/// The hit with which a search starts that skips the ray's own object. With Features::exact every
/// other hit close to it makes the ray unsure, and retracing decides which is first. The interval
/// is wide, so that whether a ray is unsure does not depend on how the other surface is searched
/// for.
template <abi::Features F, class Real>
inline HitPacket<Real> start_of_search(const StartPacket<Real>& start, const vreal<Real>& dir2,
                                       const vreal<Real>& t_max)
{
    const vreal<Real> never(static_cast<Real>(__builtin_inf()));
    const vreal<Real>& second = start.second.t;
    const auto again = second < t_max;
    HitPacket<Real> hit;
    hit.t = hit.t_low = t_max;
    hit.other = never;
    hit.surface = select(again, start.second.surface, no_surface<Real>());
    if constexpr (sizeof(Real) == sizeof(float)) {
        if (none(again))
            return hit;
        vreal<float> error = met_again_error(start, dir2);
        if constexpr (F.exact)
            error = max(error, near_own_hit(nearly_met<Real>, second, start.point, dir2));
        hit.t = select(again, second + error, t_max);
        hit.t_low = select(again, second - error, t_max);
    } else {
        // The search continues a little further, to find surfaces at the same position.
        if (any(again)) {
            const auto near = near_own_hit(nearly_met<Real>, second, start.point, dir2);
            hit.t = select(again, min(second + near, t_max), t_max);
        }
    }
    return hit;
}

inline HitAgain hit_again(const abi::ShapesView& shapes, const abi::SurfaceIndex& index)
{
    if (index.kind == abi::SurfaceKind::none)
        return HitAgain::never;
    return with_shape(shapes, index,
                      [](const auto& shape, unsigned piece) { return hit_again(shape, piece); });
}

/// Where rays from points of one surface hit it again beyond t_min, in double. `outside` are the
/// lanes that leave on the outer side.
inline OwnCrossing second_crossing(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                                   const Vec3v<double>& point, const Vec3v<double>& dir,
                                   const vreal<double>& t_min, vmask<double> outside)
{
    return with_shape(shapes, index, [&](const auto& shape, unsigned piece) {
        return second_crossing(shape, piece, point, dir, t_min, outside);
    });
}

/// The numbers of the surfaces that are hit; `first` is the number of the object's side.
template <class Real>
inline vint<Real> pieces_met(std::int32_t first, std::uint32_t low_cap, std::uint32_t high_cap)
{
    const auto number = [&](int piece) {
        return vint<Real>(static_cast<lane_int<Real>>(first + piece));
    };
    return select(from_bits<Real>(low_cap), number(1),
                  select(from_bits<Real>(high_cap), number(2), number(0)));
}

/// Where rays hit again the object whose side has the number `first`.
inline SecondHit<double> second_hit_of(const abi::ShapesView& shapes,
                                       const abi::SurfaceIndex& index, std::int32_t first,
                                       const Vec3v<double>& point, const Vec3v<double>& dir,
                                       const vreal<double>& t_min, std::uint32_t outside)
{
    const OwnCrossing met = second_crossing(shapes, index, point, dir, t_min,
                                            from_bits<double>(outside & all_lanes<double>));
    return {met.t, pieces_met<double>(first, met.low_cap, met.high_cap)};
}
inline SecondHit<float> second_hit_of(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                                      std::int32_t first, const Vec3v<float>& point,
                                      const Vec3v<float>& dir, const vreal<float>& t_min,
                                      std::uint32_t outside)
{
    const OwnCrossing low =
        second_crossing(shapes, index, widen_low(point), widen_low(dir), widen_low(t_min),
                        from_bits<double>(outside & all_lanes<double>));
    const OwnCrossing high =
        second_crossing(shapes, index, widen_high(point), widen_high(dir), widen_high(t_min),
                        from_bits<double>((outside & all_lanes<float>) >> lanes<double>));
    // A ray that leaves its object at once still hits it beyond 0.
    const vreal<float> t =
        max(narrow(low.t, high.t), vreal<float>(std::numeric_limits<float>::denorm_min()));
    return {t, pieces_met<float>(first, narrow_bits(low.low_cap, high.low_cap),
                                 narrow_bits(low.high_cap, high.high_cap))};
}

/// The number of the object's side, from the number of any of its surfaces.
inline std::int32_t first_piece(const abi::SurfaceIndex& index, std::int32_t surface)
{
    if (index.kind == abi::SurfaceKind::low_cap)
        return surface - 1;
    return index.kind == abi::SurfaceKind::high_cap ? surface - 2 : surface;
}

/// For a surface with HitAgain::from_anywhere: lanes whose rays certainly do not hit it again if
/// they leave on the outer side.
template <class Real>
inline std::uint32_t leaves_for_good(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                                     const Vec3v<Real>& dir)
{
    return with_shape(shapes, index, [&](const auto& shape, unsigned) -> std::uint32_t {
        if constexpr (requires { bends_away<Real>(shape, dir); })
            return bends_away<Real>(shape, dir);
        else
            return 0;
    });
}

/// The lanes that may hit again the object that they start on.
inline std::uint32_t may_hit_again(HitAgain again, std::uint32_t lanes_of, std::uint32_t outside)
{
    if (again == HitAgain::never)
        return 0;
    return again == HitAgain::from_inside ? lanes_of & ~outside : lanes_of;
}

/// Where rays hit again the objects that they start on, for the lanes of `active`, each from a
/// point of its own surface. `outside` are the lanes that leave on the outer side.
template <class Real>
[[gnu::noinline]] SecondHit<Real> look_for_second_hit(
    const abi::ShapesView& shapes, const vint<Real>& surface, const Vec3v<Real>& point,
    const Vec3v<Real>& dir, const vreal<Real>& t_min, std::uint32_t outside, std::uint32_t active)
{
    SecondHit<Real> hit = no_second_hit<Real>();
    for_each_distinct<Real>(surface, active, [&](lane_int<Real> number, vmask<Real> same) {
        const abi::SurfaceIndex& index = shapes.index[number];
        const HitAgain again = hit_again(shapes, index);
        std::uint32_t leavers = may_hit_again(again, bits(same) & active, outside);
        if (again == HitAgain::from_anywhere && (leavers & outside) != 0)
            leavers &= ~(outside & leaves_for_good<Real>(shapes, index, dir));
        if (leavers == 0)
            return;
        const SecondHit<Real> met =
            second_hit_of(shapes, index, first_piece(index, static_cast<std::int32_t>(number)),
                          point, dir, t_min, outside);
        hit.t = select(from_bits<Real>(leavers), met.t, hit.t);
        hit.surface = select(from_bits<Real>(leavers), met.surface, hit.surface);
    });
    return hit;
}

/// The lanes of `active` that may hit their object again. It may contain more lanes if they start
/// on several surfaces.
template <class Real>
inline std::uint32_t worth_a_search(const abi::ShapesView& shapes, const vint<Real>& surface,
                                    std::uint32_t outside, std::uint32_t active)
{
    if (!shapes.hit_again_outside || active == 0)
        return may_hit_again(HitAgain::from_inside, active, outside);
    const DistinctNumbers<Real> distinct(surface, active);
    if (!distinct.is_only())
        return active;
    return may_hit_again(hit_again(shapes, shapes.index[distinct.value()]), active, outside);
}

/// The result of look_for_second_hit(), which mostly is not called if there is nothing to find: all
/// registers are saved around a call.
template <class Real>
inline SecondHit<Real> second_hit(const abi::ShapesView& shapes, const vint<Real>& surface,
                                  const Vec3v<Real>& point, const Vec3v<Real>& dir,
                                  const vreal<Real>& t_min, std::uint32_t outside,
                                  std::uint32_t active)
{
    const std::uint32_t may_meet = worth_a_search<Real>(shapes, surface, outside, active);
    if (may_meet == 0)
        return no_second_hit<Real>();
    return look_for_second_hit<Real>(shapes, surface, point, dir, t_min, outside, may_meet);
}

/// The share of a point's magnitude that counts in its offset where its coordinate across the
/// surface is close to 0: points refined in double are off by double's roundoff there.
template <class Real>
inline constexpr Real size_share = sizeof(Real) == sizeof(float) ? Real(0x1p-20) : Real(1);

/// The offset of a ray's origin from its surface: along the outward normal, by the rounding error
/// of a point there (after Pharr, Jakob and Humphreys, Physically Based Rendering, section 6.8).
template <class Real>
inline Vec3v<Real> origin_offset(Real start_error, const Vec3v<Real>& point,
                                 const Vec3v<Real>& outward)
{
    const vreal<Real> size =
        madd(vreal<Real>(size_share<Real>), size_of(point), magnitude_dot(outward, point));
    return scale<Real>(vreal<Real>(start_error) * size, outward);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
