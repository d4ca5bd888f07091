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

/// Packets of `lanes` rays. Unused lanes of the last packet hold rays that end before they begin,
/// which are inactive for Embree.
template <int lanes>
class Packets {
public:
    using RayHit = typename PacketOf<lanes>::RayHit;

    /// With room for `most` rays.
    explicit Packets(std::size_t most) : packets_((most + lanes - 1) / lanes)
    {
    }

    void fill(const RaySet& rays, std::size_t first, std::size_t count)
    {
        count_ = (count + lanes - 1) / lanes;
        for (std::size_t p = 0; p < count_; ++p)
            for (std::size_t lane = 0; lane < lanes; ++lane)
                if (p * lanes + lane < count)
                    set_ray(packets_[p], lane, rays, first + p * lanes + lane);
                else
                    set_inactive(packets_[p], lane);
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
    // All of Embree's packets are lists of components, each for all lanes.
    static float* components(RayHit& packet)
    {
        return reinterpret_cast<float*>(&packet);
    }
    static const float* components(const RayHit& packet)
    {
        return reinterpret_cast<const float*>(&packet);
    }

    static void set_ray(RayHit& packet, std::size_t lane, const RaySet& rays, std::size_t i)
    {
        float* to = components(packet) + lane;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            to[axis * lanes] = rays.org[axis][i];
            to[(4 + axis) * lanes] = rays.dir[axis][i];
        }
        to[3 * lanes] = rays.t_min[i];
        to[8 * lanes] = rays.t_max[i];
        set_rest(to);
    }

    static void set_inactive(RayHit& packet, std::size_t lane)
    {
        float* to = components(packet) + lane;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            to[axis * lanes] = 0.0F;
            to[(4 + axis) * lanes] = 1.0F;
        }
        to[3 * lanes] = 0.0F;
        to[8 * lanes] = -1.0F;
        set_rest(to);
    }

    static void set_rest(float* to)
    {
        to[7 * lanes] = 0.0F;  // time
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
