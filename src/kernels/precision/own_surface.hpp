#pragma once

#include "kernels/geometry/packet.hpp"

// The body each ray starts on, which its search passes over: where the ray meets it again is known
// before (leave_surface.hpp).
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The lanes of `own` that are one of a body's `pieces`, which are numbered from `first` on.
template <class Real>
inline std::uint32_t lanes_on_body(const vint<Real>& own, std::int32_t first, int pieces = 1)
{
    std::uint32_t on_body = 0;
    for (int piece = 0; piece < pieces; ++piece)
        on_body |= bits(int_equal(own, vint<Real>(static_cast<lane_int<Real>>(first + piece))));
    return on_body;
}

/// How many surfaces a quadric has: its side, and two caps where it is capped.
template <class Real>
inline int pieces_of(const abi::QuadricRecord<Real>& quadric)
{
    return quadric.capped ? 3 : 1;
}

/// Rays of which none starts on a surface.
struct NoOwn {
    template <class Real>
    std::uint32_t lanes_on_others(std::int32_t, int = 1) const
    {
        return all_lanes<Real>;
    }
};

/// -1 for a ray that starts on none.
template <class Packet>
struct OwnSurface {
    Packet surface;

    /// Lanes whose rays start elsewhere than on the body of `pieces` surfaces from `first` on.
    template <class Real>
    std::uint32_t lanes_on_others(std::int32_t first, int pieces = 1) const
    {
        return ~lanes_on_body<Real>(surface, first, pieces) & all_lanes<Real>;
    }
};
template <class Packet>
OwnSurface(Packet) -> OwnSurface<Packet>;

/// No ray's own surface.
template <class Real>
inline vint<Real> no_surface()
{
    return vint<Real>(lane_int<Real>(-1));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
