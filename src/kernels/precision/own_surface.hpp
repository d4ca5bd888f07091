#pragma once

#include "kernels/geometry/object_list.hpp"

// The body each ray starts on, which its search passes over: where the ray meets it again is known
// before (leave_surface.hpp).
namespace packtrace::PACKTRACE_ISA {
namespace {

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
