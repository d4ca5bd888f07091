#pragma once

#include "kernels/packet.hpp"

// A bound of many rays: a cone of directions around an axis, started anywhere in a ball. It
// tells which objects none of the rays can reach.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct Beam {
    Real base[3] = {};  ///< centre of the ball of origins
    Real radius = 0;    ///< of that ball
    Real axis[3] = {};  ///< unit to rounding
    Real sine = 0;      ///< of the cone's half angle, which is below a right angle
    Real cosine = 1;
    Real reach = 0;        ///< no ray goes further from the base; may be infinite
    bool bounded = false;  ///< false: the rays go everywhere, nothing can be left out
};

template <class Real>
inline Real square_root(Real x)
{
    return static_cast<Real>(__builtin_sqrt(static_cast<double>(x)));
}

template <class Real>
inline Real magnitude(Real x)
{
    return x < 0 ? -x : x;
}

/// Share of a length by which a bound may be wrong through rounding; more than three times what
/// the operations below and a ray's own test can lose (docs/numerics_derivations.md has the proof),
/// so that a sphere is left out only when the exact and the rounded test of every ray say miss.
template <class Real>
inline constexpr Real beam_slack = sizeof(Real) == 4 ? Real(1e-5) : Real(1e-13);

/// Lanes whose sphere, `v` from the beam's base to its centre, may be met by a ray.
template <class Real>
inline vmask<Real> may_meet(const Beam<Real>& beam, const Vec3v<Real>& v, const vreal<Real>& radius)
{
    const Vec3v<Real> axis = broadcast(beam.axis);
    const vreal<Real> distance = sqrt(dot(v, v));
    const vreal<Real> along = dot(v, axis);
    const Vec3v<Real> moment = cross(v, axis);
    const vreal<Real> across = sqrt(dot(moment, moment));

    const vreal<Real> slack = vreal<Real>(beam_slack<Real>) * (distance + radius);
    const vreal<Real> size = radius + vreal<Real>(beam.radius) + slack;
    const vreal<Real> outside =
        msub(across, vreal<Real>(beam.cosine), along * vreal<Real>(beam.sine));
    return (outside <= size) & (along >= negated(size)) &
           (distance <= (vreal<Real>(beam.reach) + size));
}

/// Whether every ray runs against `direction` or across it, by more than rounding can turn:
/// the cone is further than a right angle from it.
template <class Real>
inline bool runs_against(const Beam<Real>& beam, const Real (&direction)[3])
{
    Real along = 0;
    Real length2 = 0;
    for (int i = 0; i < 3; ++i) {
        along += beam.axis[i] * direction[i];
        length2 += direction[i] * direction[i];
    }
    return beam.bounded && along < -(beam.sine + beam_slack<Real>)*square_root(length2);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
