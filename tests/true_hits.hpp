#pragma once

#include "aimed_rays.hpp"
#include "lab/truth/wide_truth.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

// True hits of rays in 113 bits, and whether double precision can decide them.
namespace packtrace::test {

/// Relative changes of the inputs, in roundoffs of double, within which any answer is accepted.
inline constexpr double double_band = 16.0 * 0x1p-53;

struct AimedTruth {
    std::int32_t object = -1;  ///< -1: none
    double t = 0.0;
    double condition = 0.0;
    bool decidable = true;  ///< whether double can decide if there is a hit, and of which object
    /// An end of the ray near the hit, if any; whether any object occludes the ray before that end;
    /// and whether double can decide this.
    float t_max = std::numeric_limits<float>::infinity();
    bool occluded = false;
    bool occlusion_decidable = true;
};

class Truth {
public:
    explicit Truth(const Scene& scene)
    {
        for (std::size_t i = 0; i < scene.objects.size(); ++i)
            surfaces_.emplace_back(scene.objects[i], static_cast<std::int32_t>(i));
    }

    [[nodiscard]] AimedTruth of(const StressRay& ray, StressRandom& random) const
    {
        std::vector<lab::TrueHit> hits;
        for (const lab::WideSurface& surface : surfaces_)
            lab::find_true_hits(surface, ray, hits);
        AimedTruth hit = closest(hits);
        if (hit.object >= 0)
            hit.t_max = static_cast<float>(hit.t * (1.0 + aim_error(random)));
        set_occlusion(hit, hits);
        return hit;
    }

private:
    static AimedTruth closest(const std::vector<lab::TrueHit>& hits)
    {
        const lab::TrueHit* first = nullptr;
        AimedTruth hit;
        for (const lab::TrueHit& other : hits) {
            hit.decidable = hit.decidable && other.margin >= double_band;
            if (other.exists && (first == nullptr || other.t < first->t))
                first = &other;
        }
        if (first == nullptr)
            return hit;
        hit.object = first->object;
        hit.t = static_cast<double>(first->t);
        hit.condition = first->condition;
        for (const lab::TrueHit& other : hits) {
            const double apart = double_band * (other.condition + first->condition) * hit.t;
            if (other.exists && other.object != first->object)
                hit.decidable = hit.decidable && static_cast<double>(other.t - first->t) > apart;
        }
        return hit;
    }

    static void set_occlusion(AimedTruth& hit, const std::vector<lab::TrueHit>& hits)
    {
        for (const lab::TrueHit& other : hits) {
            hit.occluded = hit.occluded || (other.exists && other.t < lab::Wide(hit.t_max));
            const double t = static_cast<double>(other.t);
            const double from_end = std::abs(static_cast<double>(other.t - lab::Wide(hit.t_max)));
            if (other.exists && std::isfinite(hit.t_max))
                hit.occlusion_decidable =
                    hit.occlusion_decidable && from_end > double_band * other.condition * t;
            hit.occlusion_decidable = hit.occlusion_decidable && other.margin >= double_band;
        }
    }

    std::vector<lab::WideSurface> surfaces_;
};

}  // namespace packtrace::test
