#pragma once

#include "kernels/packet.hpp"

// A packet of floats as two of doubles: no bit is lost on the way, and what comes back is
// rounded once.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline Vec3v<double> widen_low(const Vec3v<float>& v)
{
    return {widen_low(v.x), widen_low(v.y), widen_low(v.z)};
}
inline Vec3v<double> widen_high(const Vec3v<float>& v)
{
    return {widen_high(v.x), widen_high(v.y), widen_high(v.z)};
}

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

inline Vec3v<float> narrow(const Vec3v<double>& low, const Vec3v<double>& high)
{
    return {narrow(low.x, high.x), narrow(low.y, high.y), narrow(low.z, high.z)};
}

/// The bit pattern of a packet of floats from those of its halves.
inline std::uint32_t narrow_bits(std::uint32_t low, std::uint32_t high)
{
    return low | (high << lanes<double>);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
