#include "lab/stress/stress_subject.hpp"
#include <packtrace/intersect.hpp>

#include <algorithm>
#include <cmath>

namespace packtrace::lab {
namespace {

/// Hits with a smaller margin cannot be decided in 113 bits.
constexpr double truth_band = 0x1p-98;

/// The error of the truth: of t, and of its change by rounding the inputs.
constexpr double truth_rounding = 0x1p-104;

using Hits = std::vector<const TrueHit*>;

/// The true hits of an object; none where 113 bits cannot decide which there are.
Hits true_hits_of(const Expected& expected, std::int32_t object)
{
    Hits hits;
    for (const TrueHit& hit : expected.hits) {
        if (hit.object != object)
            continue;
        if (hit.margin < truth_band)
            return {};
        if (hit.exists)
            hits.push_back(&hit);
    }
    return hits;
}

class Checker {
public:
    void check(const TrueHit& hit, const HitBounds& bounds)
    {
        ++checks_.bounds;
        checks_.missed += !holds(bounds, hit);
        const double t = std::abs(static_cast<double>(hit.t));
        if (!bounds.empty())
            checks_.ulp.push_back(static_cast<float>((bounds.high - bounds.low) /
                                                     std::ldexp(0x1p-52, std::ilogb(t))));
    }

    /// Checks the bounds of all hits of one object.
    void check_all(const Hits& hits, const std::vector<HitBounds>& bounds)
    {
        if (hits.size() == bounds.size()) {
            for (std::size_t i = 0; i < hits.size(); ++i)
                check(*hits[i], bounds[i]);
            return;
        }
        // The kernel lost some hits, found some twice, or found false ones, whose bounds are empty.
        const bool may_be_empty = bounds.size() > hits.size();
        if (may_be_empty)
            for (const TrueHit* hit : hits) {
                const auto held =
                    std::find_if(bounds.begin(), bounds.end(),
                                 [&](const HitBounds& one) { return holds(one, *hit); });
                check(*hit, held == bounds.end() ? bounds.front() : *held);
            }
        for (const HitBounds& one : bounds) {
            if (hits.empty() || (may_be_empty && one.empty()))
                continue;
            const auto held = std::find_if(hits.begin(), hits.end(),
                                           [&](const TrueHit* hit) { return holds(one, *hit); });
            check(held == hits.end() ? *hits.front() : **held, one);
        }
    }

    [[nodiscard]] const BoundChecks& checks() const
    {
        return checks_;
    }

private:
    static bool holds(const HitBounds& bounds, const TrueHit& hit)
    {
        const Wide slack = Wide(hit.spread) * truth_rounding + magnitude(hit.t) * truth_rounding;
        return bounds.low <= hit.t + slack && bounds.high >= hit.t - slack;
    }

    BoundChecks checks_;
};

}  // namespace

void BoundChecks::add(const BoundChecks& other)
{
    bounds += other.bounds;
    missed += other.missed;
    ulp.insert(ulp.end(), other.ulp.begin(), other.ulp.end());
}

template <class Real>
BoundChecks check_bounds(const StressSubject& subject, const StressGroup& group)
{
    const RayScene<Real> scene(group.scene, subject.options);
    const RayColumns<Real> columns = columns_of<Real>(group.rays);
    const RaysView<Real> rays = columns.view();
    std::vector<Real> t(rays.count);
    std::vector<std::int32_t> object(rays.count);
    scene.closest_hits(rays, {t.data(), object.data()});
    std::vector<HitBounds> bounds(rays.count);
    scene.bound_closest_hits(rays, object.data(), bounds.data());
    Checker checker;
    for (std::size_t i = 0; i < rays.count; ++i) {
        const Hits hits = true_hits_of(group.expected[i], object[i]);
        if (object[i] >= 0 && !hits.empty())
            checker.check(*hits.front(), bounds[i]);
    }
    scene.all_hits(rays, [&](std::size_t ray, std::span<const SurfaceHit<Real>> all) {
        bounds.resize(all.size());
        scene.bound_all_hits(rays, ray, all, bounds);
        std::vector<bool> done(all.size());
        for (std::size_t first = 0; first < all.size(); ++first) {
            if (done[first])
                continue;
            std::vector<HitBounds> of_object;
            for (std::size_t i = first; i < all.size(); ++i)
                if (all[i].object == all[first].object) {
                    of_object.push_back(bounds[i]);
                    done[i] = true;
                }
            checker.check_all(true_hits_of(group.expected[ray], all[first].object), of_object);
        }
    });
    return checker.checks();
}

template BoundChecks check_bounds<float>(const StressSubject&, const StressGroup&);
template BoundChecks check_bounds<double>(const StressSubject&, const StressGroup&);

}  // namespace packtrace::lab
