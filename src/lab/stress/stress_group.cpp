#include "lab/stress/stress_subject.hpp"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace packtrace::lab {
namespace {

/// From so many objects on, those that a ray passes by far are left out in double.
constexpr std::size_t many = 8;

/// A line passes by far where it does so by this share of all sizes, ten thousand times what any
/// band is wide.
constexpr double far_off = 1e-5;

SphereScreen screen_of(const Object& object)
{
    const Sphere* sphere = std::get_if<Sphere>(&object.surface);
    if (sphere == nullptr || object.transform != Mat4(1.0))
        return {};
    return {sphere->center, sphere->radius,
            far_off * (sphere->radius + glm::length(sphere->center))};
}

/// A ray that is held against many spheres.
class Screen {
public:
    explicit Screen(const StressRay& ray)
        : ray_(ray),
          length_(glm::length(ray.dir)),
          dir_(ray.dir / length_),
          slack_(far_off * glm::length(ray.org))
    {
    }

    /// Where the line enters a sphere at the earliest; infinity where it passes it by far.
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
        // It leaves the sphere between these two places.
        if (crosses && middle + std::sqrt(inner * inner - across2) > ray_.t_min * length_ &&
            middle + outer < ray_.t_max * length_)
            sure_hit_ = std::min(sure_hit_, (middle + outer) / length_);
        return (middle - outer) / length_;
    }

    /// What is entered behind this is behind a hit that is one beyond doubt.
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

/// How far a ray's start is inside a closed body, in the body's own space; negative outside.
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
            constexpr double well = 1e-6;
            const double depth = depth_inside(group.surfaces[0], ray);
            expected.certain = depth > well;
            expected.even = depth < -well;
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
