#pragma once

#include "kernels/packet.hpp"

// A packet of floats as two of doubles: no bit is lost on the way, and what comes back is
// rounded once.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline Vec3v<double> low_half(const Vec3v<float>& v)
{
    return {low_half(v.x), low_half(v.y), low_half(v.z)};
}
inline Vec3v<double> high_half(const Vec3v<float>& v)
{
    return {high_half(v.x), high_half(v.y), high_half(v.z)};
}

inline RayPacket<double> with_square(const Vec3v<double>& org, const Vec3v<double>& dir,
                                     const vreal<double>& t_min)
{
    return {org, dir, dot(dir, dir), t_min};
}
inline RayPacket<double> low_half(const RayPacket<float>& rays)
{
    return with_square(low_half(rays.org), low_half(rays.dir), low_half(rays.t_min));
}
inline RayPacket<double> high_half(const RayPacket<float>& rays)
{
    return with_square(high_half(rays.org), high_half(rays.dir), high_half(rays.t_min));
}

inline Vec3v<float> joined(const Vec3v<double>& low, const Vec3v<double>& high)
{
    return {joined(low.x, high.x), joined(low.y, high.y), joined(low.z, high.z)};
}

/// The bit pattern of a packet of floats from those of its halves.
inline std::uint32_t joined_bits(std::uint32_t low, std::uint32_t high)
{
    return low | (high << lanes<double>);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
