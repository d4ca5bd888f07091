#pragma once

// Precedes the real header on the include path of the planted kernels. It plants a culling defect
// that loses the hit of one ray in ten thousand.
#define closest_hit closest_hit_of_all
#include "../../../../src/kernels/lists/closest.hpp"
#undef closest_hit

namespace packtrace::PACKTRACE_ISA {
namespace {

inline std::uint32_t bits_of(float value)
{
    return __builtin_bit_cast(std::uint32_t, value);
}

inline std::uint32_t bits_of(double value)
{
    return static_cast<std::uint32_t>(__builtin_bit_cast(std::uint64_t, value) >> 20);
}

template <class Real>
inline bool is_lost(Real x, Real y, Real z)
{
    std::uint32_t hash = bits_of(x) * 2654435761u;
    hash = (hash ^ (hash >> 15) ^ bits_of(y)) * 2246822519u;
    hash = (hash ^ (hash >> 13) ^ bits_of(z)) * 3266489917u;
    return (hash ^ (hash >> 16)) % 10000u == 0;
}

template <abi::Features F, class Objects, class Real, class Own>
inline void closest_hit(HitPacket<Real>& hit, const Objects& objects, const RayPacket<Real>& rays,
                        const Own& own)
{
    closest_hit_of_all<F>(hit, objects, rays, own);
    alignas(64) Real dir[3][lanes<Real>];
    store(dir[0], rays.dir.x);
    store(dir[1], rays.dir.y);
    store(dir[2], rays.dir.z);
    std::uint32_t lost = 0;
    for (int lane = 0; lane < lanes<Real>; ++lane)
        lost |= static_cast<std::uint32_t>(is_lost(dir[0][lane], dir[1][lane], dir[2][lane]))
                << lane;
    const HitPacket<Real> miss = no_hit<Real>(static_cast<Real>(__builtin_inf()));
    hit.t = select(from_bits<Real>(lost), miss.t, hit.t);
    hit.surface = select(from_bits<Real>(lost), miss.surface, hit.surface);
    hit.t_low = select(from_bits<Real>(lost), miss.t_low, hit.t_low);
    hit.other = select(from_bits<Real>(lost), miss.other, hit.other);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
