#include "lab/truth/wide_truth.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace packtrace::lab {
namespace {

constexpr double boundless = std::numeric_limits<double>::infinity();

/// A hit that nearly exists has moved when it does exist, by less than this share of its t.
constexpr double may_move = 0x1p-10;

/// Relative change of the inputs that brings two hits to one place.
double margin_of_order(const TrueHit& first, const TrueHit& other)
{
    const double gap = static_cast<double>(other.t - first.t);
    const double spread = first.spread + other.spread;
    return spread > 0.0 ? gap / spread : boundless;
}

/// Relative change of the inputs after which a hit that does not exist would come before the first
/// one if it did.
double margin_of_front(const TrueHit& hit, const TrueHit* first)
{
    if (first == nullptr || hit.t <= first->t * (1.0 + may_move))
        return 0.0;
    return margin_of_order(*first, hit);
}

void set_hit(const TrueHit& first, const StressRay& ray, Expected& expected)
{
    expected.object = first.object;
    expected.piece = first.piece;
    expected.t = first.t;
    expected.normal = narrow(first.normal);
    expected.cosine =
        static_cast<double>(reference::dot(first.normal, wide(ray.dir))) / glm::length(ray.dir);
    expected.condition = first.condition;
    expected.normal_spread = first.normal_spread;
    expected.margin = first.margin;
    expected.root_margin = first.side_margin;
}

/// Takes the smallest of the margins at which another hit would become the answer.
void limit_margins(const std::vector<TrueHit>& hits, const TrueHit* first, Expected& expected)
{
    for (const TrueHit& hit : hits) {
        if (&hit == first)
            continue;
        if (hit.exists) {
            double& margin = hit.object == first->object ? expected.root_margin : expected.margin;
            margin = std::min(margin, margin_of_order(*first, hit));
        } else {
            expected.margin =
                std::min(expected.margin, std::max(hit.margin, margin_of_front(hit, first)));
        }
    }
}

}  // namespace

double margin_of_end(const TrueHit& hit, double roundoff)
{
    const double gap = hit.end_gap - 2.0 * roundoff;
    return gap <= 0.0 ? 0.0 : gap / hit.condition;
}

Expected expect(const StressRay& ray, std::vector<TrueHit> hits, double roundoff)
{
    std::sort(hits.begin(), hits.end(), [](const TrueHit& a, const TrueHit& b) {
        return a.t < b.t || (a.t == b.t && a.object < b.object);
    });
    const auto found =
        std::find_if(hits.begin(), hits.end(), [](const TrueHit& hit) { return hit.exists; });
    const TrueHit* first = found == hits.end() ? nullptr : &*found;
    Expected expected;
    expected.margin = expected.root_margin = expected.end_margin = boundless;
    if (first != nullptr)
        set_hit(*first, ray, expected);
    limit_margins(hits, first, expected);
    for (const TrueHit& hit : hits)
        expected.end_margin = std::min(expected.end_margin, std::max(margin_of_end(hit, roundoff),
                                                                     margin_of_front(hit, first)));
    if (ray.exact)
        expected.margin = expected.root_margin = boundless;
    expected.hits = std::move(hits);
    return expected;
}

}  // namespace packtrace::lab
