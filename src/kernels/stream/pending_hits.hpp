#pragma once

#include "kernels/precision/refine.hpp"

// Hits of packets in which few rays hit anything. They wait until there are enough for a packet,
// and are refined together. A refined hit depends only on the ray and its surface, so it does not
// matter which hits are refined together.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <abi::Features F, class Real>
class PendingHits {
public:
    /// `t` is the array of the stream's t; a refined t is written at its ray's index.
    PendingHits(const abi::ShapesView& shapes, Real* t) : shapes_(shapes), t_(t)
    {
    }

    /// Whether it is faster to let the hits in these lanes wait.
    static bool is_worth_it(std::uint32_t found)
    {
        return __builtin_popcount(found) <= lanes<Real> * 3 / 4;
    }

    /// Adds the hits in the lanes `found` of the packet at index `at`. Their surfaces are not those
    /// that the rays start on.
    void add(const RayPacket<Real>& rays, const HitPacket<Real>& hit, std::uint32_t found, int at)
    {
        if (found == 0)
            return;
        const int count = count_;
        compress_store(org_[0] + count, found, rays.org.x);
        compress_store(org_[1] + count, found, rays.org.y);
        compress_store(org_[2] + count, found, rays.org.z);
        compress_store(dir_[0] + count, found, rays.dir.x);
        compress_store(dir_[1] + count, found, rays.dir.y);
        compress_store(dir_[2] + count, found, rays.dir.z);
        compress_store(t_min_ + count, found, rays.t_min);
        if constexpr (asks_for_t)
            compress_store(found_ + count, found, hit.t);
        compress_store(surface_ + count, found, hit.surface);
        compress_store(at_ + count, found, lane_numbers<Real>(at));
        count_ = count + __builtin_popcount(found);
        if (count_ >= lanes<Real>)
            refine_last(lanes<Real>);
    }

    /// Refines and writes the hits that still wait.
    void finish()
    {
        if (count_ != 0)
            refine_last(count_);
    }

private:
    [[gnu::noinline]] void refine_last(int count)
    {
        count_ -= count;
        RayPacket<Real> rays;
        rays.org = {load(org_[0] + count_), load(org_[1] + count_), load(org_[2] + count_)};
        rays.dir = {load(dir_[0] + count_), load(dir_[1] + count_), load(dir_[2] + count_)};
        rays.dir2 = dot(rays.dir, rays.dir);
        rays.t_min = load(t_min_ + count_);
        RefinedHits<Real, Refine::t> hits;
        hits.t = rays.t_min;
        refine_others(hits, shapes_, rays, asks_for_t ? load(found_ + count_) : rays.t_min,
                      load(surface_ + count_), first_lanes<Real>(count));
        alignas(64) Real t[lanes<Real>];
        store(t, hits.t);
        for (int i = 0; i < count; ++i)
            t_[at_[count_ + i]] = t[i];
    }

    /// Only quadrics need the t that the search found.
    static constexpr bool asks_for_t = F.quadrics;
    /// A packet of added hits, and fewer than a packet that wait.
    static constexpr std::size_t capacity = 2 * lanes<Real>;

    const abi::ShapesView& shapes_;
    Real* t_;
    int count_ = 0;
    alignas(64) Real org_[3][capacity];
    alignas(64) Real dir_[3][capacity];
    alignas(64) Real t_min_[capacity];
    alignas(64) Real found_[capacity];
    alignas(64) lane_int<Real> surface_[capacity];
    alignas(64) lane_int<Real> at_[capacity];
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
