#pragma once

#include "kernels/simd/vec3.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// One ray per lane. Directions need not be unit vectors; t counts in their lengths.
template <class Real>
struct RayPacket {
    Vec3v<Real> org;
    Vec3v<Real> dir;
    vreal<Real> dir2;   ///< dir·dir
    vreal<Real> t_min;  ///< >= 0; hits must be beyond it
};

/// The closest hit so far of each lane. With Features::exact its t is known as an interval.
template <class Real>
struct HitPacket {
    vreal<Real> t;  ///< hits must be before it; with Features::exact the upper end of the interval
    vint<Real> surface;  ///< -1: none yet
    vreal<Real> t_low;   ///< with Features::exact: the lower end of the interval
    vreal<Real> other;   ///< with Features::exact: every other hit is certainly at this t or later
};

template <class Real>
inline RayPacket<Real> make_rays(const Vec3v<Real>& org, const Vec3v<Real>& dir, Real t_min)
{
    return {org, dir, dot(dir, dir), vreal<Real>(t_min)};
}

template <class Real>
inline HitPacket<Real> no_hit(const batch<Real>& end)
{
    return {end, vint<Real>(lane_int<Real>(-1)), end,
            vreal<Real>(static_cast<Real>(__builtin_inf()))};
}
template <class Real>
inline HitPacket<Real> no_hit(Real t_max)
{
    return no_hit<Real>(vreal<Real>(t_max));
}

/// Keeps the hits at `t` where `valid` and closer. At equal t the lower surface number wins, so the
/// order of the tests does not matter.
template <class Real>
inline void keep_closer(HitPacket<Real>& hit, batch_bool<Real> valid, batch<Real> t,
                        std::int32_t surface)
{
    const vint<Real> number(static_cast<lane_int<Real>>(surface));
    const auto nearer = valid & (t < hit.t);
    const auto ties = valid & (t == hit.t) & int_less(number, hit.surface);
    const auto take = either(nearer, ties);
    hit.t = select(take, t, hit.t);
    hit.surface = select(take, number, hit.surface);
}

/// A packet of vectors, stored so that lanes can be read one by one.
template <class Real>
struct LaneVectors {
    alignas(64) Real axis[3][lanes<Real>];

    explicit LaneVectors(const Vec3v<Real>& v)
    {
        store(axis[0], v.x);
        store(axis[1], v.y);
        store(axis[2], v.z);
    }
    void copy(int lane, Real (&to)[3]) const
    {
        for (int i = 0; i < 3; ++i)
            to[i] = axis[i][lane];
    }
};

// A packet of rays in single precision as two packets in double.

inline RayPacket<double> with_square(const Vec3v<double>& org, const Vec3v<double>& dir,
                                     const vreal<double>& t_min)
{
    return {org, dir, dot(dir, dir), t_min};
}
inline RayPacket<double> widen_low(const RayPacket<float>& rays)
{
    return with_square(widen_low(rays.org), widen_low(rays.dir), widen_low(rays.t_min));
}
inline RayPacket<double> widen_high(const RayPacket<float>& rays)
{
    return with_square(widen_high(rays.org), widen_high(rays.dir), widen_high(rays.t_min));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
