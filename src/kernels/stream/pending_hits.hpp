#pragma once

#include "kernels/precision/refine.hpp"

// Hits of packets in which few rays hit anything: they wait until there is a packet of them, and
// are refined together. What refining finds hangs on a ray and its surface alone, so that it does
// not matter who comes along.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <abi::Features F, class Real>
class PendingHits {
public:
    /// The t of a hit goes to where in `t` its ray stands.
    PendingHits(const abi::ShapesView& shapes, Real* t) : shapes_(shapes), t_(t)
    {
    }

    /// Whether it pays that hits in these lanes of a packet wait.
    static bool is_worth_it(std::uint32_t found)
    {
        return __builtin_popcount(found) <= lanes<Real> * 3 / 4;
    }

    /// Hits in the lanes `found` of a packet, which stands at `at`, on surfaces that their rays
    /// don't start on.
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

    /// Refines what is left.
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

    /// Where the search found them matters to quadrics alone.
    static constexpr bool asks_for_t = F.quadrics;
    /// What is left of a packet, and a packet more.
    static constexpr std::size_t room = 2 * lanes<Real>;

    const abi::ShapesView& shapes_;
    Real* t_;
    int count_ = 0;
    alignas(64) Real org_[3][room];
    alignas(64) Real dir_[3][room];
    alignas(64) Real t_min_[room];
    alignas(64) Real found_[room];
    alignas(64) lane_int<Real> surface_[room];
    alignas(64) lane_int<Real> at_[room];
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
