#pragma once

#include "kernels/vec3.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// One ray per lane. Directions need not be unit; t counts in their lengths.
template <class Real>
struct RayPacket {
    Vec3v<Real> org;
    Vec3v<Real> dir;
    vreal<Real> dir2;   ///< dir·dir
    vreal<Real> t_min;  ///< >= 0; hits must lie beyond it
};

/// The closest hit so far of each lane.
template <class Real>
struct HitPacket {
    vreal<Real> t;       ///< hits must lie before it
    vint<Real> surface;  ///< -1: none yet
};

template <class Real>
inline RayPacket<Real> make_rays(const Vec3v<Real>& org, const Vec3v<Real>& dir, Real t_min)
{
    return {org, dir, dot(dir, dir), vreal<Real>(t_min)};
}

template <class Real>
inline HitPacket<Real> no_hit(Real t_max)
{
    return {vreal<Real>(t_max), vint<Real>(lane_int<Real>(-1))};
}

/// Takes the hits at `t` where `valid` and closer; at equal t the lower surface number wins, so
/// that the order of testing does not matter.
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

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
