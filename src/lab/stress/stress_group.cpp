#include "lab/stress/stress_subject.hpp"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace packtrace::lab {
namespace {

/// With more objects, those that a ray surely misses are found in double and skipped.
constexpr std::size_t many = 8;

/// A line surely misses a sphere if it misses it by this share of all sizes: ten thousand times the
/// width of any band.
constexpr double far_off = 1e-5;

/// A start is well inside or outside a closed body if it is this far from its surface, in the units
/// of the body's own space.
constexpr double well_off_surface = 1e-6;

SphereScreen screen_of(const Object& object)
{
    const Sphere* sphere = std::get_if<Sphere>(&object.surface);
    if (sphere == nullptr || object.transform != Mat4(1.0))
        return {};
    return {sphere->center, sphere->radius,
            far_off * (sphere->radius + glm::length(sphere->center))};
}

/// Tests one ray against many spheres.
class Screen {
public:
    explicit Screen(const StressRay& ray)
        : ray_(ray),
          length_(glm::length(ray.dir)),
          dir_(ray.dir / length_),
          slack_(far_off * glm::length(ray.org))
    {
    }

    /// A lower bound of the t at which the line enters a sphere; infinite if it surely misses it.
    [[nodiscard]] double entry(const SphereScreen& sphere)
    {
        if (sphere.radius < 0.0)
            return -no_end;
        const Vec3 o = sphere.center - ray_.org;
        const double middle = glm::dot(o, dir_);
        const double slack = sphere.slack + slack_;
        const double outer = sphere.radius + slack;
        const double across2 = glm::dot(o, o) - middle * middle;
        if (across2 > outer * outer || middle + outer < ray_.t_min * length_)
            return no_end;
        const double inner = sphere.radius - slack;
        const bool crosses = inner > 0.0 && across2 < inner * inner;
        // The ray leaves the sphere between these two t, so it surely hits it.
        if (crosses && middle + std::sqrt(inner * inner - across2) > ray_.t_min * length_ &&
            middle + outer < ray_.t_max * length_)
            sure_hit_ = std::min(sure_hit_, (middle + outer) / length_);
        return (middle - outer) / length_;
    }

    /// An upper bound of the t of the first hit, by the spheres tested so far.
    [[nodiscard]] double sure_hit() const
    {
        return sure_hit_;
    }

private:
    const StressRay& ray_;
    double length_;
    Vec3 dir_;
    double slack_;
    double sure_hit_ = no_end;
};

}  // namespace

std::vector<TrueHit> StressGroup::hits_of(const StressRay& ray) const
{
    std::vector<TrueHit> hits;
    if (surfaces.size() <= many) {
        for (const WideSurface& surface : surfaces)
            find_true_hits(surface, ray, hits);
        return hits;
    }
    Screen screen(ray);
    std::vector<std::pair<double, std::size_t>> near_ones;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const double entry = screen.entry(screens[i]);
        if (entry < no_end)
            near_ones.emplace_back(entry, i);
    }
    for (const auto& [entry, i] : near_ones)
        if (entry <= screen.sure_hit())
            find_true_hits(surfaces[i], ray, hits);
    return hits;
}

StressGroup stress_group(Scene scene)
{
    StressGroup group;
    group.scene = std::move(scene);
    for (const Object& object : group.scene.objects) {
        group.surfaces.emplace_back(object, static_cast<std::int32_t>(group.surfaces.size()));
        group.screens.push_back(screen_of(object));
    }
    return group;
}

namespace {

/// How deep a ray's start is inside a closed body, in the body's own space; negative outside.
double depth_inside(const WideSurface& body, const StressRay& ray)
{
    const WideVec p = body.point_to_own(wide(ray.org));
    const double side = -static_cast<double>(body.value(p));
    const double above = static_cast<double>(p.z) - body.z_range->low;
    const double below = body.z_range->high - static_cast<double>(p.z);
    return std::min({side, above, below});
}

template <class Real>
StressGroup make_group(const StressFamily& family, std::uint64_t seed, std::size_t number, int rays)
{
    StressRandom random(seed);
    const bool known = number < family.known.size();
    StressCase one = known ? family.known[number]() : family.make(random);
    round_to_precision<Real>(one.scene);
    StressGroup group = stress_group(std::move(one.scene));
    for (int i = 0; i < rays; ++i) {
        StressRay ray = one.ray(random);
        round_to_precision<Real>(ray);
        Expected expected = expect(ray, group.hits_of(ray), roundoff_of<Real>);
        if (family.closed && group.surfaces[0].capped) {
            const double depth = depth_inside(group.surfaces[0], ray);
            expected.certain = depth > well_off_surface;
            expected.even = depth < -well_off_surface;
        }
        group.rays.push_back(ray);
        group.expected.push_back(std::move(expected));
    }
    return group;
}

}  // namespace

template <class Real>
std::vector<StressGroup> make_groups(const StressFamily& family, std::uint64_t seed, int rays)
{
    StressRandom random(seed);
    std::uint64_t mixed = random.bits();
    for (const char letter : family.name)
        mixed = StressRandom(mixed ^ static_cast<unsigned char>(letter)).bits();
    std::vector<StressGroup> groups(static_cast<std::size_t>(family.scenes));
    tbb::parallel_for(0, family.scenes, [&](int i) {
        const int share = rays / family.scenes + (i < rays % family.scenes ? 1 : 0);
        groups[static_cast<std::size_t>(i)] = make_group<Real>(
            family, mixed + static_cast<std::uint64_t>(i), static_cast<std::size_t>(i), share);
    });
    return groups;
}

template std::vector<StressGroup> make_groups<float>(const StressFamily&, std::uint64_t, int);
template std::vector<StressGroup> make_groups<double>(const StressFamily&, std::uint64_t, int);

}  // namespace packtrace::lab
