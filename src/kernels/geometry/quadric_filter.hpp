#pragma once

#include "kernels/geometry/ball_filter.hpp"
#include "kernels/geometry/quadric.hpp"
#include "kernels/geometry/quadric_body.hpp"

// Quadrics for rays in single precision: a certain rejection, and behind it the test in double,
// two half packets at a time.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A quadric for the origins of one group.
struct QuadricFilter {
    const abi::QuadricRecord<float>* record;
    const abi::QuadricRecord<double>* wide;
    float p[3];             ///< a shared origin in canonical space, rounded once from double
    BallFilter ball;        ///< around it; infinite for an unbounded quadric
    float moment_error[3];  ///< of m = p × v, per |d|
    float dir_error[3];     ///< of v, per |d|
    float most_error;       ///< of the discriminant, per d·d
};

inline float row_length(const float (&row)[3])
{
    return __builtin_sqrtf(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]) * inflation;
}

inline float square_error(float x, float dx)
{
    return (2 * x + dx) * dx + roundoffs(9.0f) * x * x;
}
inline float product_error(float x, float dx, float y, float dy)
{
    return x * dy + y * dx + dx * dy + roundoffs(9.0f) * x * y;
}

/// Bounds below this may have lost terms to underflow, and say nothing.
inline constexpr float smallest_error = 0x1p-90f;

/// The error of the discriminant of any ray, at most: by the largest |v| and |m| there are.
inline float most_error(const QuadricFilter& filter, const float (&row)[3], float reach)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    float size[3];
    float moment[3];
    for (int axis = 0; axis < 3; ++axis) {
        size[axis] = magnitude(quadric.square[axis]);
        moment[axis] = row[(axis + 1) % 3] * row[(axis + 2) % 3] * reach;
    }
    float error = 0;
    for (int axis = 0; axis < 3; ++axis) {
        error += size[(axis + 1) % 3] * size[(axis + 2) % 3] *
                 square_error(moment[axis], filter.moment_error[axis]);
        error += magnitude(quadric.constant) * size[axis] *
                 square_error(row[axis], filter.dir_error[axis]);
    }
    const float linear = magnitude(quadric.linear);
    if (linear > 0) {
        for (int axis = 0; axis < 2; ++axis)
            error += 2 * linear * size[1 - axis] *
                     product_error(row[1 - axis], filter.dir_error[1 - axis], moment[axis],
                                   filter.moment_error[axis]);
        error += linear * linear * square_error(row[2], filter.dir_error[2]);
    }
    return error * inflation;
}

template <bool Shared>
[[gnu::noinline]] QuadricFilter quadric_filter(const abi::QuadricRecord<float>& record,
                                               const abi::QuadricRecord<double>& wide,
                                               const Origins& origins)
{
    QuadricFilter filter{};
    filter.record = &record;
    filter.wide = &wide;
    filter.ball = ball_filter<Shared>(wide.bound, record.bound_radius, origins);
    double distance2 = 0;
    double w[3];
    for (int axis = 0; axis < 3; ++axis) {
        w[axis] = double{origins.center[axis]} - wide.center[axis] - wide.center_low[axis];
        distance2 += w[axis] * w[axis];
    }
    const float reach =
        (static_cast<float>(__builtin_sqrt(distance2)) + origins.radius) * inflation;
    float row[3];
    for (int axis = 0; axis < 3; ++axis) {
        row[axis] = row_length(record.inverse[axis]);
        filter.dir_error[axis] = roundoffs(4.2f) * row[axis];
        if (Shared)
            filter.p[axis] =
                static_cast<float>(wide.inverse[axis][0] * w[0] + wide.inverse[axis][1] * w[1] +
                                   wide.inverse[axis][2] * w[2]);
    }
    for (int axis = 0; axis < 3; ++axis)
        filter.moment_error[axis] =
            roundoffs(26.0f) * row[(axis + 1) % 3] * row[(axis + 2) % 3] * reach;
    filter.most_error = most_error(filter, row, reach);
    return filter;
}

/// Lanes that surely miss the surface: those that cross the unclipped side nowhere and, where there
/// are caps, are outside of it all along.
template <bool Shared>
[[gnu::noinline]] std::uint32_t surely_misses(const QuadricFilter& filter,
                                              const RayPacket<float>& rays, const RayScale& scale)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    const Vec3v<float> p =
        Shared ? broadcast(filter.p) : quadric_origin<float>(quadric, rays.org).p;
    const Vec3v<float> v = apply_inverse(quadric, rays.dir);
    const Vec3v<float> m = cross(p, v);
    const Vec3v<float> s = broadcast(quadric.square);
    const vreal<float> k(quadric.constant);
    const vreal<float> a = dot(s * v, v);
    const vreal<float> discriminant = quadric_discriminant<float>(quadric, m, v, a);
    const std::uint32_t negative = bits(discriminant < vreal<float>(0.0f));
    const vreal<float> most = vreal<float>(filter.most_error) * rays.dir2;
    const std::uint32_t by_most =
        bits((discriminant < negated(most)) & (most > vreal<float>(smallest_error)));
    if (negative == 0 || (by_most == negative && !quadric.capped))
        return by_most;
    // The error of each product of two values x, y known to dx, dy: |x| dy + |y| dx + dx dy, and
    // the rounding of the sums.
    const vreal<float> l(quadric.linear);
    const vreal<float> two(2.0f);
    const vreal<float> rounding(roundoffs(9.0f));
    const auto size3 = [](const Vec3v<float>& x) {
        return Vec3v<float>{abs(x.x), abs(x.y), abs(x.z)};
    };
    const Vec3v<float> length{scale.length, scale.length, scale.length};
    const Vec3v<float> dm = length * broadcast(filter.moment_error);
    const Vec3v<float> dv = length * broadcast(filter.dir_error);
    const Vec3v<float> sm = size3(m);
    const Vec3v<float> sv = size3(v);
    const auto square_error = [&](const vreal<float>& x, const vreal<float>& dx) {
        return madd(madd(two, x, dx), dx, rounding * (x * x));
    };
    const auto product_error = [&](const vreal<float>& x, const vreal<float>& dx,
                                   const vreal<float>& y, const vreal<float>& dy) {
        return madd(x, dy, madd(y, dx, madd(dx, dy, rounding * (x * y))));
    };
    const Vec3v<float> size = size3(s);
    vreal<float> error = (size.y * size.z) * square_error(sm.x, dm.x);
    error = madd(size.z * size.x, square_error(sm.y, dm.y), error);
    error = madd(size.x * size.y, square_error(sm.z, dm.z), error);
    const vreal<float> of_a =
        madd(size.x, square_error(sv.x, dv.x),
             madd(size.y, square_error(sv.y, dv.y), size.z * square_error(sv.z, dv.z)));
    error = madd(abs(k), of_a, error);
    if (quadric.linear != 0) {
        const vreal<float> turn = madd(size.y, product_error(sv.y, dv.y, sm.x, dm.x),
                                       size.x * product_error(sv.x, dv.x, sm.y, dm.y));
        error = madd(two * abs(l), turn, madd(l * l, square_error(sv.z, dv.z), error));
    }
    const std::uint32_t misses = bits((discriminant < negated(error) * vreal<float>(inflation)) &
                                      (error > vreal<float>(smallest_error)));
    return quadric.capped ? misses & bits(a > of_a * vreal<float>(inflation)) : misses;
}

/// Lanes that may hit the quadric between t_min and t_end, in double to be looked at.
template <bool Shared>
inline std::uint32_t may_hit(const QuadricFilter& filter, const RayPacket<float>& rays,
                             const RayScale& scale, const vreal<float>& t_end)
{
    std::uint32_t near = all_lanes<float>;
    if (filter.ball.outer2 < __builtin_inff())
        near = may_hit_ball<Shared>(filter.ball, rays, scale, t_end);
    return near == 0 ? 0 : near & ~surely_misses<Shared>(filter, rays, scale);
}

/// Where half a packet crosses a quadric beyond t_min: roots 0 and 1 are the side's, 2 and 3 the
/// caps'.
struct HalfCrossings {
    vreal<double> t[4] = {vreal<double>(0.0), vreal<double>(0.0), vreal<double>(0.0),
                          vreal<double>(0.0)};
    std::uint32_t valid[4] = {};
};

[[gnu::noinline]] inline HalfCrossings half_crossings(const abi::QuadricRecord<double>& quadric,
                                                      const RayPacket<double>& rays)
{
    HalfCrossings result;
    int sides = 0;
    visit_crossings(quadric, quadric_origin<double>(quadric, rays.org), rays,
                    [&](vmask<double> valid, const vreal<double>& t, int piece) {
                        const int at = piece == 0 ? sides++ : piece + 1;
                        result.t[at] = t;
                        result.valid[at] |= bits(valid & (t > rays.t_min));
                    });
    return result;
}

/// Calls `visit(lanes, low, high, piece)` for the crossings beyond t_min of the lanes of `active`.
template <class Visit>
inline void visit_in_double(const abi::QuadricRecord<double>& quadric, const RayPacket<float>& rays,
                            std::uint32_t active, const Visit& visit)
{
    HalfCrossings low;
    HalfCrossings high;
    if ((active & all_lanes<double>) != 0)
        low = half_crossings(quadric, widen_low(rays));
    if (active >> lanes<double> != 0)
        high = half_crossings(quadric, widen_high(rays));
    for (int at = 0; at < 4; ++at) {
        const std::uint32_t valid = narrow_bits(low.valid[at], high.valid[at]) & active;
        if (valid == 0)
            continue;
        const vreal<float> t = narrow(low.t[at], high.t[at]);
        visit(valid, rounded_low(t), rounded_high(t), at < 2 ? 0 : at - 1);
    }
}

inline Body body_of(const QuadricFilter& quadric)
{
    return body_of(*quadric.record);
}

template <bool Shared>
inline QuadricFilter certain_form(const abi::QuadricRecord<float>& record,
                                  const abi::QuadricRecord<double>& wide, const Origins& origins)
{
    return quadric_filter<Shared>(record, wide, origins);
}

/// What may hit is tested in double.
template <bool Shared, class Own>
inline void keep_certain(HitPacket<float>& hit, const QuadricFilter& filter,
                         const RayPacket<float>& rays, const RayScale& scale, const Own& own)
{
    const Body body = body_of(filter);
    const std::uint32_t active = may_hit<Shared>(filter, rays, scale, hit.t) &
                                 own.template lanes_on_others<float>(body.first, body.pieces);
    if (active == 0)
        return;
    visit_in_double(
        *filter.wide, rays, active,
        [&](std::uint32_t lanes_of, const vreal<float>& low, const vreal<float>& high, int piece) {
            keep_sure(hit, from_bits<float>(lanes_of), low, high, body.first + piece);
        });
}

/// What any piece does to the lanes that do not start on it.
template <bool Shared, class Own>
inline Occlusion occludes(const QuadricFilter& filter, const RayPacket<float>& rays,
                          const RayScale& scale, const vreal<float>& t_end, const Own& own)
{
    std::uint32_t active = may_hit<Shared>(filter, rays, scale, t_end);
    if (active == 0)
        return {};
    const auto [first, pieces] = body_of(filter);
    active &= own.template lanes_on_others<float>(first, pieces);
    Occlusion result;
    visit_in_double(
        *filter.wide, rays, active,
        [&](std::uint32_t lanes_of, const vreal<float>& low, const vreal<float>& high, int) {
            const Occlusion at = root_between(low, high, lanes_of, rays.t_min, t_end);
            result.blocked |= at.blocked;
            result.unsure |= at.unsure;
        });
    result.unsure &= ~result.blocked;
    return result;
}

/// The kind (kinds.hpp).
struct Quadric {
    static constexpr abi::Primitive primitive = abi::Primitive::quadric;
    static constexpr abi::SurfaceKind first_surface = abi::SurfaceKind::quadric_side;
    static constexpr unsigned surfaces = 3;
    template <class Real>
    using FromPoint = ObjectArray<SharedOriginQuadric<Real>>;
    using Certain = ObjectArray<QuadricFilter>;

    static constexpr bool in(abi::Features features)
    {
        return features.quadrics;
    }
    template <class Real>
    static const auto& list(const abi::GeometryView<Real>& scene)
    {
        return scene.quadrics;
    }
    static const auto* shapes(const abi::ShapesView& shapes)
    {
        return shapes.quadrics;
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
