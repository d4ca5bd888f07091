#include "study/self_hits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <packtrace/intersect.hpp>

#include "study/stress_random.hpp"

namespace packtrace::study {
namespace {

using reference::dot;

/// Rays in arrays, and where their hits go.
template <class Real>
struct Stream {
    std::array<std::vector<Real>, 8> rays;
    std::array<std::vector<Real>, 4> hits;    ///< t, normal
    std::array<std::vector<Real>, 9> starts;  ///< outer, inner, the hit point itself
    std::vector<std::int32_t> object;
    std::vector<std::int32_t> surface;
    // Where these rays themselves start, of rays that leave hits.
    std::array<std::vector<Real>, 3> own_point;
    std::vector<std::int32_t> own_surface;

    void add(const Vec3& org, const Vec3& dir, double t_min, double t_max)
    {
        const double values[8] = {org.x, org.y, org.z, dir.x, dir.y, dir.z, t_min, t_max};
        for (std::size_t i = 0; i < 8; ++i)
            rays[i].push_back(static_cast<Real>(values[i]));
    }

    void add_start(const Vec3& point, std::int32_t own)
    {
        for (int axis = 0; axis < 3; ++axis)
            own_point[static_cast<std::size_t>(axis)].push_back(static_cast<Real>(point[axis]));
        own_surface.push_back(own);
    }

    void trace(const RayScene<Real>& scene)
    {
        const std::size_t n = rays[0].size();
        for (auto& column : hits)
            column.resize(n);
        for (auto& column : starts)
            column.resize(n);
        object.resize(n);
        surface.resize(n);
        const auto& r = rays;
        auto& s = starts;
        const RaysView<Real> in{r[0].data(), r[1].data(), r[2].data(),
                                r[3].data(), r[4].data(), r[5].data(),
                                r[6].data(), r[7].data(), n};
        const HitsView<Real> out{hits[0].data(),
                                 object.data(),
                                 hits[1].data(),
                                 hits[2].data(),
                                 hits[3].data(),
                                 {s[0].data(), s[1].data(), s[2].data()},
                                 {s[3].data(), s[4].data(), s[5].data()},
                                 {s[6].data(), s[7].data(), s[8].data()},
                                 surface.data()};
        if (own_surface.empty())
            return scene.closest_hits(in, out);
        const auto& p = own_point;
        scene.closest_hits(in, {{p[0].data(), p[1].data(), p[2].data()}, own_surface.data()}, out);
    }

    /// Of hit i: 0 the outer start, 1 the inner one, 2 the hit point.
    [[nodiscard]] Vec3 start(std::size_t i, std::size_t which) const
    {
        const std::size_t first = 3 * which;
        return {starts[first][i], starts[first + 1][i], starts[first + 2][i]};
    }
};

/// The meeting that a primary ray's answer means, where that is beyond doubt.
const Meeting* meant(const std::vector<Meeting>& meetings, double t)
{
    const Meeting* best = nullptr;
    for (const Meeting& meeting : meetings) {
        if (std::min(meeting.margin, meeting.end_margin) < 0x1p-20)
            return nullptr;
        if (meeting.exists &&
            (best == nullptr || abs(meeting.t - Wide(t)) < abs(best->t - Wide(t))))
            best = &meeting;
    }
    return best;
}

/// To either side of the surface, half of them grazing it.
Vec3 any_direction(StressRandom& random, const Vec3& normal)
{
    const Vec3 along = across(random, normal);
    const double cosine = random.below(2) == 0 ? random.power(1e-4, 0.1) : random.between(0.1, 1.0);
    return along * std::sqrt(1.0 - cosine * cosine) + random.sign() * cosine * normal;
}

/// Where a ray from P, which counts as of the surface, meets it again; 0 for nowhere. The side
/// that it leaves on says which way it crosses, as for kernels: rounding P may turn a grazing ray.
double second_meeting(const WideSurface& surface, const WideVec& P, const WideVec& d, bool outside)
{
    const WideVec v = surface.direction_to_own(d);
    const Wide a = dot(surface.second_order(v), v);
    const Wide size = abs(dot(surface.gradient(surface.point_to_own(P)), v));
    const Wide b = outside ? size : Wide(-size);
    return a == 0 ? 0.0 : std::max(0.0, static_cast<double>(-2 * b / a));
}

/// t of a second meeting, 0 for none, and whether the way there is less deep below the surface
/// than four times what the hit point is off by.
struct Expected {
    double t;
    bool shallow;
};

Vec3 narrow(const WideVec& v)
{
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

}  // namespace

void SelfHitCounts::add(const SelfHitCounts& other)
{
    rays += other.rays;
    taken += other.taken;
    lost += other.lost;
}

namespace {

template <class Real>
Stream<Real> primary_stream(const StressGroup& group)
{
    Stream<Real> primary;
    for (const StressRay& ray : group.rays)
        primary.add(ray.org, ray.dir, ray.t_min, ray.t_max);
    return primary;
}

/// Adds a ray from where primary ray i hit, if that is beyond doubt, and its second meeting. It
/// starts at the hit point as rounded, which is all that is known of it: so does the truth.
template <class Real>
void add_secondary(const StressGroup& group, const Stream<Real>& primary, std::size_t i,
                   StressRandom& random, double t_min, Stream<Real>& secondary,
                   std::vector<Expected>& expected)
{
    const Meeting* meeting = meant(group.meetings[i], primary.hits[0][i]);
    if (meeting == nullptr || primary.object[i] < 0)
        return;
    const Vec3 normal = narrow(meeting->normal);
    Vec3 dir = any_direction(random, normal);
    for (int axis = 0; axis < 3; ++axis)
        dir[axis] = static_cast<double>(static_cast<Real>(dir[axis]));
    const WideVec P = wide(group.rays[i].org) + meeting->t * wide(group.rays[i].dir);
    const bool outside = dot(wide(dir), meeting->normal) > 0;
    secondary.add(primary.start(i, outside ? 0 : 1), dir, t_min,
                  std::numeric_limits<double>::infinity());
    const Vec3 start = primary.start(i, 2);
    secondary.add_start(start, outside ? primary.surface[i] : ~primary.surface[i]);
    const double second = second_meeting(group.surfaces[0], wide(start), wide(dir), outside);
    const double moved = glm::length(narrow(wide(start) - P));
    expected.push_back({second, second * std::abs(glm::dot(dir, normal)) / 4.0 < 4.0 * moved});
}

/// Holds the hit of one secondary ray against what is expected of it; of shallow chords by the
/// exact rule alone.
void count(SelfHitCounts& counts, const Expected& expected, SelfHits rule, bool hit, double t)
{
    ++counts.rays;
    const bool excused = rule == SelfHits::note && expected.shallow;
    if (expected.t == 0.0)
        counts.taken += hit;
    else if (!excused && (!hit || std::abs(t - expected.t) > 0.1 * expected.t))
        ++(hit && t < 0.5 * expected.t ? counts.taken : counts.lost);
}

}  // namespace

template <class Real>
SelfHitCounts count_self_hits(const StressSubject& subject, const StressGroup& group, SelfHits rule)
{
    if (subject.kernel != "packet" || group.surfaces.size() != 1 || group.surfaces[0].z_range)
        return {};
    RenderOptions options = subject.options;
    options.self_hits = rule;
    const RayScene<Real> scene(group.scene, options);
    Stream<Real> primary = primary_stream<Real>(group);
    primary.trace(scene);

    StressRandom random(group.rays.size());
    Stream<Real> secondary;
    std::vector<Expected> expected;
    const double t_min = rule == SelfHits::note ? 0.001 : 0.0;
    for (std::size_t i = 0; i < group.rays.size(); ++i)
        add_secondary(group, primary, i, random, t_min, secondary, expected);
    secondary.trace(scene);

    SelfHitCounts counts;
    for (std::size_t i = 0; i < expected.size(); ++i)
        count(counts, expected[i], rule, secondary.object[i] >= 0,
              static_cast<double>(secondary.hits[0][i]));
    return counts;
}

template SelfHitCounts count_self_hits<float>(const StressSubject&, const StressGroup&, SelfHits);
template SelfHitCounts count_self_hits<double>(const StressSubject&, const StressGroup&, SelfHits);

}  // namespace packtrace::study
