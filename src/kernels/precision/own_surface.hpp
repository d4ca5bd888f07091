#pragma once

#include "kernels/geometry/object_list.hpp"

// The object that each ray starts on, which the search skips: where the ray hits it again is
// already known (leave_surface.hpp).
namespace packtrace::PACKTRACE_ISA {
namespace {

/// For rays that start on no surface.
struct NoOwn {
    static constexpr bool all_on(const Body&)
    {
        return false;
    }
    template <class Real>
    std::uint32_t lanes_on_others(std::int32_t, int = 1) const
    {
        return all_lanes<Real>;
    }
};

/// The surfaces that a packet of rays starts on; -1 for a ray that starts on none.
template <class Packet>
struct OwnSurface {
    Packet surface;
    std::int32_t common = -1;  ///< the surface that all active rays start on; -1 if they differ

    /// Whether all rays start on `body`, so that none is tested against it.
    bool all_on(const Body& body) const
    {
        return is_on(body, common);
    }

    /// Lanes that do not start on the object of `pieces` surfaces from `first` on. Only called if
    /// all_on() is false for it.
    template <class Real>
    std::uint32_t lanes_on_others(std::int32_t first, int pieces = 1) const
    {
        if (common >= 0)
            return all_lanes<Real>;
        return ~lanes_on_body<Real>(surface, first, pieces) & all_lanes<Real>;
    }
};
template <class Packet>
OwnSurface(Packet) -> OwnSurface<Packet>;
template <class Packet>
OwnSurface(Packet, std::int32_t) -> OwnSurface<Packet>;

/// `first` is the surface of any lane of `active`.
template <class Real>
inline OwnSurface<vint<Real>> own_with_common(const vint<Real>& surface, lane_int<Real> first,
                                              std::uint32_t active)
{
    const std::uint32_t others = active & ~bits(int_equal(surface, vint<Real>(first)));
    return {surface, others == 0 ? static_cast<std::int32_t>(first) : -1};
}

/// The own surface of rays that start on none.
template <class Real>
inline vint<Real> no_surface()
{
    return vint<Real>(lane_int<Real>(-1));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
