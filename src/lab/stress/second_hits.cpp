#include "lab/stress/evaluate.hpp"
#include "lab/stress/stress_random.hpp"
#include "lab/stress/stress_subject.hpp"
#include "reference/start.hpp"
#include <packtrace/intersect.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace packtrace::lab {
namespace {

using reference::dot;

/// Second rays are traced only if all decisions about them have at least this margin.
constexpr double decided_margin = 0x1p-20;

/// In scenes of several objects, where the truth takes long, one of so many hits gets a second ray.
constexpr std::size_t hits_a_second_ray = 4;

/// The allowed relative error of a second hit's t.
constexpr double second_bound = 1e-6;

/// A second hit with a larger relative error of t is another hit, and so lost.
constexpr double lost_error = 0.1;

/// The other root is far off the level of the start's equation if the gradient there is this many
/// times smaller than at the start.
constexpr int much_steeper = 4;

/// A chord is shallow if its depth is less than this many times the error of the hit point.
constexpr double shallow_factor = 4.0;

/// The smallest positive number of single precision.
constexpr double least_single = 0x1p-149;

/// The side of a surface on which a ray leaves it.
enum class Side { outside, inside };

/// A random direction to either side of the surface; half of them graze it.
Vec3 any_direction(StressRandom& random, const Vec3& normal)
{
    const Vec3 along = across(random, normal);
    const double cosine = random.below(2) == 0 ? random.power(1e-4, 0.1) : random.between(0.1, 1.0);
    return along * std::sqrt(1.0 - cosine * cosine) + random.sign() * cosine * normal;
}

Vec3 times(const WideVec (&rows)[3], const Vec3& v)
{
    Vec3 sum;
    for (int row = 0; row < 3; ++row)
        sum[row] = glm::dot(sizes(rows[row]), v);
    return sum;
}

/// The relative change of -2 b / a for relative changes 1 of the inputs of a and b.
double condition_of_second(const WideSurface& surface, const WideVec& P, const WideVec& d,
                           const Wide& a, const Wide& b)
{
    const Vec3 way = sizes(d);
    const Vec3 place = sizes(P) + sizes(surface.offset);
    const Vec3 v = surface.placed ? times(surface.own, way) : way;
    const Vec3 p = surface.placed ? times(surface.own, place) : place;
    const Vec3 gradient = times(surface.square, p) + sizes(surface.linear);
    return glm::dot(v, times(surface.square, v)) / std::abs(static_cast<double>(a)) +
           glm::dot(v, gradient) / std::abs(static_cast<double>(b));
}

/// The distance of a height from the ends of a z range, relative to both.
double clip_margin(const ZRange& range, double z)
{
    double margin = std::numeric_limits<double>::infinity();
    for (const double bound : {range.low, range.high})
        if (std::isfinite(bound))
            margin = std::min(margin, std::abs(z - bound) / (std::abs(z) + std::abs(bound)));
    return margin;
}

/// The other root of a ray from P, which counts as a point of the surface; t = 0 for none. The side
/// decides the sign of the slope at P, as in kernels: rounding P may change it for a grazing ray.
TrueHit hit_from(const WideSurface& surface, const WideVec& P, const WideVec& d, Side side)
{
    const WideVec v = surface.direction_to_own(d);
    const Wide a = dot(surface.second_order(v), v);
    const Wide size = magnitude(dot(surface.gradient(surface.point_to_own(P)), v));
    const Wide b = side == Side::outside ? size : Wide(-size);
    TrueHit hit;
    hit.object = surface.object;
    hit.margin = std::numeric_limits<double>::infinity();
    if (a == 0 || b / a >= 0)
        return hit;
    hit.exists = true;
    hit.t = -2 * b / a;
    if (surface.z_range) {
        const WideVec own = surface.point_to_own(P + hit.t * d);
        hit.exists = own.z >= surface.z_range->low && own.z <= surface.z_range->high;
        hit.margin = clip_margin(*surface.z_range, static_cast<double>(own.z));
    }
    hit.condition = condition_of_second(surface, P, d, a, b);
    hit.spread = hit.condition * static_cast<double>(hit.t);
    return hit;
}

WideVec world_gradient(const WideSurface& surface, const WideVec& P)
{
    return surface.covector_to_world(surface.gradient(surface.point_to_own(P)));
}

/// The point of the surface next to P by Newton's method; P itself if its first step leads no
/// nearer.
WideVec next_on(const WideSurface& surface, const WideVec& P)
{
    const auto value_at = [&](const WideVec& at) {
        return surface.value(surface.point_to_own(at));
    };
    const auto step_from = [&](const WideVec& at) {
        const WideVec gradient = world_gradient(surface, at);
        return at + (-value_at(at) / (2 * dot(gradient, gradient))) * gradient;
    };
    WideVec at = step_from(P);
    if (magnitude(value_at(at)) > magnitude(value_at(P)) / 16)
        return P;
    for (int i = 0; i < 5; ++i)
        at = step_from(at);
    return at;
}

/// The other root of a ray from the rounded point P. P counts as a point of the surface, and the
/// other root is then on the same level of the equation as P. If the gradient is so much smaller
/// there that this level is far off the surface, the ray starts at the point of the surface next to
/// P instead.
TrueHit other_root(const WideSurface& surface, const WideVec& P, const WideVec& d, Side side)
{
    TrueHit hit = hit_from(surface, P, d, side);
    if (hit.t == 0)
        return hit;
    const WideVec near = world_gradient(surface, P);
    const WideVec far = world_gradient(surface, P + hit.t * d);
    if (much_steeper * much_steeper * dot(far, far) >= dot(near, near))
        return hit;
    return hit_from(surface, next_on(surface, P), d, side);
}

/// The truth of a ray that leaves a hit.
struct Leaving {
    TrueHit own;  ///< the other root of the surface that it starts on
    /// The least t of a hit with any piece of the object that it starts on; infinite for none.
    double own_object = std::numeric_limits<double>::infinity();
    Expected expected;
    bool shallow = false;  ///< see shallow_factor
};

}  // namespace

void SecondHits::add(const SecondHits& other)
{
    rays += other.rays;
    taken += other.taken;
    lost += other.lost;
    inexact += other.inexact;
    errors.insert(errors.end(), other.errors.begin(), other.errors.end());
}

namespace {

/// Rays that leave hits.
template <class Real>
struct Secondary {
    RayColumns<Real> rays;
    StartColumns<Real> starts;
    std::vector<Leaving> leaving;
};

/// Whether the answer of primary ray i is certainly the expected hit.
template <class Real>
bool leaves(const StressGroup& group, const LeftHitColumns<Real>& primary, std::size_t i)
{
    const Expected& expected = group.expected[i];
    if (expected.object < 0 || !expected.root_decided(decided_margin) ||
        expected.normal == Vec3(0.0))
        return false;
    return verdict_of(expected, answer_of(primary, i), double_band, roundoff_of<float>) ==
           Verdict::right;
}

/// The truth of `ray`, which leaves `hit` from `start`; none if a decision about it is too close.
std::optional<Leaving> leaving_of(const StressGroup& group, const Expected& hit, const Vec3& start,
                                  const StressRay& ray, Side side, double roundoff)
{
    const WideSurface& surface = group.surfaces[static_cast<std::size_t>(hit.object)];
    const bool others = group.surfaces.size() > 1 || surface.z_range;
    Leaving leaving;
    leaving.own.object = hit.object;
    leaving.own.margin = std::numeric_limits<double>::infinity();
    if (hit.piece == 0)
        leaving.own = other_root(surface, wide(start), wide(ray.dir), side);
    std::vector<TrueHit> hits = others ? group.hits_of(ray) : std::vector<TrueHit>{};
    std::erase_if(hits, [&](const TrueHit& other) {
        return other.object == hit.object && other.piece == hit.piece;
    });
    hits.push_back(leaving.own);
    for (const TrueHit& other : hits)
        if (other.exists && other.object == hit.object)
            leaving.own_object = std::min(leaving.own_object, static_cast<double>(other.t));
    leaving.expected = expect(ray, std::move(hits), roundoff);
    if (others && !leaving.expected.decided(decided_margin))
        return std::nullopt;
    return leaving;
}

/// Whether the chord of a ray that leaves a hit is shallow.
bool is_shallow(const StressRay& primary, const Expected& hit, const Vec3& start, const Vec3& dir,
                const TrueHit& own)
{
    const WideVec P = wide(primary.org) + hit.t * wide(primary.dir);
    const double point_error = glm::length(narrow(wide(start) - P));
    const double depth = static_cast<double>(own.t) * std::abs(glm::dot(dir, hit.normal)) / 4.0;
    return depth < shallow_factor * point_error;
}

/// Adds a ray from the hit of primary ray i, if that is certain, and its truth. The truth starts at
/// the rounded hit point, too, because kernels know no other.
template <class Real>
void add_secondary(const StressGroup& group, const LeftHitColumns<Real>& primary, std::size_t i,
                   StressRandom& random, double t_min, Secondary<Real>& secondary)
{
    if (!leaves(group, primary, i))
        return;
    const Expected& hit = group.expected[i];
    Vec3 dir = any_direction(random, hit.normal);
    for (int axis = 0; axis < 3; ++axis)
        dir[axis] = static_cast<double>(static_cast<Real>(dir[axis]));
    const bool outside = glm::dot(dir, hit.normal) > 0.0;
    const Vec3 start = vector_at(primary.point, i);
    const Vec3 offset_start = vector_at(outside ? primary.outer_start : primary.inner_start, i);
    std::optional<Leaving> leaving =
        leaving_of(group, hit, start, {offset_start, dir, t_min, no_end},
                   outside ? Side::outside : Side::inside, roundoff_of<Real>);
    if (!leaving)
        return;
    leaving->shallow = is_shallow(group.rays[i], hit, start, dir, leaving->own);
    secondary.rays.add(offset_start, dir, t_min);
    secondary.starts.add(start, outside ? primary.surface[i] : ~primary.surface[i]);
    secondary.leaving.push_back(*std::move(leaving));
}

/// Compares the hit of one secondary ray with its truth. By the notes' rule shallow chords do not
/// count.
void count(SecondHits& counts, const Leaving& leaving, SelfHits rule, std::int32_t object, double t)
{
    ++counts.rays;
    const bool excused = rule == SelfHits::note && leaving.shallow && leaving.own.exists;
    if (excused)
        return;
    const std::int32_t own = leaving.own.object;
    const double second = static_cast<double>(leaving.own.t);
    const double expected = static_cast<double>(leaving.expected.t);
    if (object == own && t < 0.5 * leaving.own_object) {
        ++counts.taken;
        return;
    }
    if (object != leaving.expected.object ||
        (object == own && std::abs(t - expected) > lost_error * expected + least_single)) {
        ++counts.lost;
        return;
    }
    if (object != own || !leaving.own.exists || expected != second)
        return;
    const double error = std::abs(static_cast<double>((Wide(t) - leaving.own.t) / leaving.own.t));
    counts.errors.push_back(static_cast<float>(error));
    const double allowed =
        second_bound + 4.0 * 0x1p-53 * leaving.own.condition + least_single / second;
    counts.inexact += error > allowed;
}

bool has_crossing_planes(const StressGroup& group)
{
    return std::any_of(group.surfaces.begin(), group.surfaces.end(),
                       [](const WideSurface& surface) { return surface.sheets.has_value(); });
}

}  // namespace

template <class Real>
SecondHits trace_second_hits(const StressSubject& subject, const StressGroup& group, SelfHits rule)
{
    if (subject.kernel != "packet" || has_crossing_planes(group))
        return {};
    RenderOptions options = subject.options;
    options.self_hits = rule;
    const RayScene<Real> scene(group.scene, options);
    LeftHitColumns<Real> primary(group.rays.size());
    scene.closest_hits(columns_of<Real>(group.rays).view(), primary.view());

    StressRandom random(group.rays.size());
    Secondary<Real> secondary;
    const double t_min = rule == SelfHits::note ? reference::epsilon<double> : 0.0;
    const std::size_t step = group.surfaces.size() > 1 ? hits_a_second_ray : 1;
    for (std::size_t i = 0; i < group.rays.size(); i += step)
        add_secondary(group, primary, i, random, t_min, secondary);
    LeftHitColumns<Real> hits(secondary.rays.size());
    scene.closest_hits(secondary.rays.view(), secondary.starts.view(), hits.view());

    SecondHits counts;
    for (std::size_t i = 0; i < secondary.leaving.size(); ++i)
        count(counts, secondary.leaving[i], rule, hits.object[i], static_cast<double>(hits.t[i]));
    return counts;
}

template SecondHits trace_second_hits<float>(const StressSubject&, const StressGroup&, SelfHits);
template SecondHits trace_second_hits<double>(const StressSubject&, const StressGroup&, SelfHits);

}  // namespace packtrace::lab
