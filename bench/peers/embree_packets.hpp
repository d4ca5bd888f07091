#pragma once

#include "ray_set.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <vector>

// Embree's packets of 1, 4, 8 and 16 rays, filled from ray sets and read back.
namespace packtrace::peers {

template <int lanes>
struct PacketOf;
template <>
struct PacketOf<1> {
    using RayHit = RTCRayHit;
    static void intersect(const int*, RTCScene scene, RTCIntersectContext* context, RayHit* rays)
    {
        rtcIntersect1(scene, context, rays);
    }
    static void occluded(const int*, RTCScene scene, RTCIntersectContext* context, RayHit* rays)
    {
        rtcOccluded1(scene, context, &rays->ray);
    }
};
#define PACKTRACE_PACKET_OF(lanes)                                                            \
    template <>                                                                               \
    struct PacketOf<lanes> {                                                                  \
        using RayHit = RTCRayHit##lanes;                                                      \
        static void intersect(const int* valid, RTCScene scene, RTCIntersectContext* context, \
                              RayHit* rays)                                                   \
        {                                                                                     \
            rtcIntersect##lanes(valid, scene, context, rays);                                 \
        }                                                                                     \
        static void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context,  \
                             RayHit* rays)                                                    \
        {                                                                                     \
            rtcOccluded##lanes(valid, scene, context, &rays->ray);                            \
        }                                                                                     \
    }

PACKTRACE_PACKET_OF(4);
PACKTRACE_PACKET_OF(8);
PACKTRACE_PACKET_OF(16);
#undef PACKTRACE_PACKET_OF

/// Room for `count` rays as packets of so many lanes; the last packet's spare lanes hold rays
/// that end before they begin, which Embree takes for inactive.
template <int lanes>
class Packets {
public:
    using RayHit = typename PacketOf<lanes>::RayHit;

    explicit Packets(std::size_t most) : packets_((most + lanes - 1) / lanes)
    {
    }

    void fill(const RaySet& rays, std::size_t first, std::size_t count)
    {
        count_ = (count + lanes - 1) / lanes;
        for (std::size_t p = 0; p < count_; ++p)
            for (std::size_t lane = 0; lane < lanes; ++lane)
                set(packets_[p], lane, rays, first + p * lanes + lane, p * lanes + lane < count);
    }

    void read_closest(std::size_t first, std::size_t count, Hits& hits) const
    {
        for (std::size_t i = 0; i < count; ++i) {
            const float* packet = components(packets_[i / lanes]);
            const auto* ids = reinterpret_cast<const unsigned*>(packet);
            hits.t[first + i] = packet[8 * lanes + i % lanes];
            const bool hit = ids[18 * lanes + i % lanes] != RTC_INVALID_GEOMETRY_ID;
            hits.object[first + i] =
                hit ? static_cast<std::int32_t>(ids[17 * lanes + i % lanes]) : -1;
        }
    }

    void read_occluded(std::size_t first, std::size_t count, Hits& hits) const
    {
        for (std::size_t i = 0; i < count; ++i)
            hits.occluded[first + i] = components(packets_[i / lanes])[8 * lanes + i % lanes] < 0;
    }

    [[nodiscard]] RayHit* data()
    {
        return packets_.data();
    }
    [[nodiscard]] std::size_t size() const
    {
        return count_;
    }

private:
    // Every layout of Embree's is a list of components, each of all lanes.
    static float* components(RayHit& packet)
    {
        return reinterpret_cast<float*>(&packet);
    }
    static const float* components(const RayHit& packet)
    {
        return reinterpret_cast<const float*>(&packet);
    }

    static void set(RayHit& packet, std::size_t lane, const RaySet& rays, std::size_t i,
                    bool active)
    {
        float* to = components(packet) + lane;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            to[axis * lanes] = active ? rays.org[axis][i] : 0.0F;
            to[(4 + axis) * lanes] = active ? rays.dir[axis][i] : 1.0F;
        }
        to[3 * lanes] = active ? rays.t_min[i] : 0.0F;
        to[7 * lanes] = 0.0F;  // time
        to[8 * lanes] = active ? rays.t_max[i] : -1.0F;
        auto* ids = reinterpret_cast<unsigned*>(to);
        ids[9 * lanes] = ~0U;  // mask
        ids[10 * lanes] = 0;   // id
        ids[11 * lanes] = 0;   // flags
        ids[17 * lanes] = ids[18 * lanes] = ids[19 * lanes] = RTC_INVALID_GEOMETRY_ID;
    }

    std::vector<RayHit> packets_;
    std::size_t count_ = 0;
};

}  // namespace packtrace::peers
