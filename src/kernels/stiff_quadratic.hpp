#pragma once

#include "kernel_abi/stiff.hpp"
#include "kernels/halves.hpp"
#include "kernels/huge_sphere.hpp"
#include "kernels/plane.hpp"
#include "kernels/quadric.hpp"
#include "kernels/sphere.hpp"

// Rays in single precision against surfaces in double. Everything that can cancel is computed in
// double; what is left, square roots and divisions, is well conditioned and is done in single,
// at half the cost.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline Quadratic<double> quadratic_of(const abi::StiffSphere& sphere, const RayPacket<double>& rays)
{
    const vreal<double> radius2(sphere.radius2);
    const Vec3v<double> o = rays.org - broadcast(sphere.center);
    return sphere_quadratic<double>(rays, o, radius2, sphere_constant<double>(o, radius2));
}

/// A quadratic rounded from double, and what double says of it.
struct RoundedQuadratic {
    Quadratic<float> rounded;
    std::uint32_t ahead;  ///< lanes with roots t > 0
};

inline RoundedQuadratic rounded(const Quadratic<double>& low, const Quadratic<double>& high)
{
    return {{joined(low.a, high.a), joined(low.b, high.b), joined(low.c, high.c),
             joined(low.discriminant, high.discriminant)},
            joined_bits(bits(may_hit(low)), bits(may_hit(high)))};
}

/// Calls `visit(valid, t, 0)` for either root, unless none is ahead.
template <class Surface, class Visit>
inline void visit_stiff_roots(const Surface& surface, const RayPacket<float>& rays,
                              const Visit& visit)
{
    const auto [quadratic, ahead] =
        rounded(quadratic_of(surface, low_half(rays)), quadratic_of(surface, high_half(rays)));
    if (ahead == 0)
        return;
    const vmask<float> valid = from_bits<float>(ahead);
    const vreal<float> root = sqrt(quadratic.discriminant);
    const vreal<float> minus_q = quadratic.b + with_sign_of(root, quadratic.b);
    visit(valid, negated(quadratic.c) / minus_q, 0);
    visit(valid, negated(minus_q) / quadratic.a, 0);
}

/// t = height / slope of the plane; both are computed in double.
template <class Plane>
inline vreal<double> plane_slope(const Plane& plane, const RayPacket<double>& rays)
{
    return dot(broadcast(plane.normal), rays.dir);
}
inline vreal<double> height_of(const abi::PlaneRecord<double>& plane, const RayPacket<double>& rays)
{
    return plane_height<double>(plane, rays.org);
}
inline vreal<double> height_of(const SharedOriginPlane<double>& plane, const RayPacket<double>&)
{
    return vreal<double>(plane.height);
}

template <class Plane, class Visit>
inline void visit_stiff_plane(const Plane& plane, const RayPacket<float>& rays, const Visit& visit)
{
    const RayPacket<double> low = low_half(rays);
    const RayPacket<double> high = high_half(rays);
    const vreal<float> height = joined(height_of(plane, low), height_of(plane, high));
    const vreal<float> slope = joined(plane_slope(plane, low), plane_slope(plane, high));
    visit(from_bits<float>(all_lanes<float>), height / slope, 0);
}

/// Where half a packet crosses a quadric: roots 0 and 1 are the side's, 2 and 3 the caps'.
struct HalfCrossings {
    vreal<double> t[4] = {vreal<double>(0.0), vreal<double>(0.0), vreal<double>(0.0),
                          vreal<double>(0.0)};
    std::uint32_t valid[4] = {};
};

template <class Quadric>
inline HalfCrossings half_crossings(const Quadric& quadric, const RayPacket<double>& rays)
{
    HalfCrossings result;
    int sides = 0;
    visit_crossings(quadric, rays, [&](vmask<double> valid, const vreal<double>& t, int piece) {
        const int place = piece == 0 ? sides++ : piece + 1;
        result.t[place] = t;
        result.valid[place] = bits(valid);
    });
    return result;
}

/// Clipping hangs on t, so all of it is in double.
template <class Quadric, class Visit>
inline void visit_stiff_quadric(const Quadric& quadric, const RayPacket<float>& rays,
                                const Visit& visit)
{
    const HalfCrossings low = half_crossings(quadric, low_half(rays));
    const HalfCrossings high = half_crossings(quadric, high_half(rays));
    for (int place = 0; place < 4; ++place) {
        const std::uint32_t valid = joined_bits(low.valid[place], high.valid[place]);
        if (valid != 0)
            visit(from_bits<float>(valid), joined(low.t[place], high.t[place]),
                  place < 2 ? 0 : place - 1);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
