#include "agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace packtrace::peers {
namespace {

constexpr double tolerance = 1e-4;  ///< of t
constexpr double ground_radius = 100.0;

/// One side's answer to a ray, with the truth.
struct Claim {
    std::int32_t object;
    double t;
    double true_t;  ///< of that object; infinity for a miss
    bool ground;
};

Claim claim_of(const Scene& scene, const RaySet& rays, const Hits& hits, std::size_t i)
{
    const std::int32_t object = hits.object[i];
    if (object < 0)
        return {object, 0.0, std::numeric_limits<double>::infinity(), false};
    const auto& sphere = std::get<Sphere>(scene.objects[static_cast<std::size_t>(object)].surface);
    return {object, static_cast<double>(hits.t[i]), true_distance(rays, i, sphere),
            sphere.radius > ground_radius};
}

/// Whether the ray misses the claim's object, or hits that of the other claim earlier.
bool is_wrong(const Claim& claim, const Claim& other)
{
    if (claim.object >= 0 && std::isinf(claim.true_t))
        return true;
    return claim.true_t > other.true_t * (1.0 + tolerance);
}

void count_difference(Agreement& sum, const Claim& our, const Claim& their)
{
    const bool our_wrong = is_wrong(our, their);
    const bool their_wrong = is_wrong(their, our);
    if (!our_wrong && !their_wrong) {
        ++sum.ties;
        return;
    }
    ++(our.ground || their.ground ? sum.objects_differ_on_ground : sum.objects_differ);
    sum.ours_wrong += our_wrong;
    sum.theirs_wrong += their_wrong;
}

double error_of(const Claim& claim)
{
    if (claim.object < 0 || claim.ground || std::isinf(claim.true_t))
        return 0.0;
    return std::abs(claim.t - claim.true_t) / claim.true_t;
}

}  // namespace

Agreement compare_closest(const Scene& scene, const RaySet& rays, const Hits& ours,
                          const Hits& theirs)
{
    Agreement sum{.rays = rays.size()};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Claim our = claim_of(scene, rays, ours, i);
        const Claim their = claim_of(scene, rays, theirs, i);
        sum.our_largest_error = std::max(sum.our_largest_error, error_of(our));
        sum.their_largest_error = std::max(sum.their_largest_error, error_of(their));
        sum.hit_by_both += our.object >= 0 && their.object >= 0;
        if (our.object != their.object)
            count_difference(sum, our, their);
        else if (our.object >= 0 && std::abs(our.t - their.t) > tolerance * our.t)
            ++(our.ground ? sum.distances_differ_on_ground : sum.distances_differ);
    }
    return sum;
}

std::size_t count_occlusion_differences(const Hits& ours, const Hits& theirs)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < ours.occluded.size(); ++i)
        count += ours.occluded[i] != theirs.occluded[i];
    return count;
}

}  // namespace packtrace::peers
