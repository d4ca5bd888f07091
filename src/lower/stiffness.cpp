#include "lower/stiffness.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

#include "lower/in_parallel.hpp"

namespace packtrace {
namespace {

/// How many times its own size a surface may be away from the origin, or longer than it is wide,
/// before its points and normals lose more than a digit to single precision's places; measured
/// in docs/numerics.md.
constexpr double far_ratio = 512.0;
constexpr double stretch_ratio = 16.0;

bool fits_single(double x)
{
    return static_cast<double>(static_cast<float>(x)) == x;
}

bool is_stiff(const LoweredSphere& sphere)
{
    return glm::length(sphere.center) > far_ratio * sphere.radius;
}

bool is_stiff(const LoweredHugeSphere&)
{
    return true;
}

/// Along an axis and at a place that float has, a plane's only rounding is a subtraction's.
bool is_stiff(const LoweredPlane& plane)
{
    int components = 0;
    bool exact = true;
    for (int axis = 0; axis < 3; ++axis) {
        if (plane.normal[axis] == 0.0)
            continue;
        ++components;
        exact = exact && fits_single(plane.point[axis]);
    }
    return components > 1 || !exact;
}

bool is_stiff(const LoweredQuadric& quadric)
{
    double narrowest = 0.0;
    for (int row = 0; row < 3; ++row)
        narrowest = std::max(narrowest, glm::length(glm::row(quadric.inverse, row)));
    return quadric.condition > stretch_ratio || glm::length(quadric.center) * narrowest > far_ratio;
}

/// Whether a hierarchy could hold the surface, were it not stiff.
bool bounded(const LoweredSphere&)
{
    return true;
}
bool bounded(const LoweredHugeSphere&)
{
    return false;
}
bool bounded(const LoweredPlane&)
{
    return false;
}
bool bounded(const LoweredQuadric& quadric)
{
    return std::isfinite(quadric.bound_radius);
}

/// Every ray meets every stiff object, so there must not be many: of more bounded ones than
/// this, single precision finds the nearest.
constexpr std::ptrdiff_t longest_list = 32;

template <class Surfaces>
void mark(Accuracy accuracy, Surfaces& surfaces)
{
    for_each_in_parallel(surfaces, [&](auto& surface) {
        surface.stiff =
            accuracy == Accuracy::robust || (accuracy == Accuracy::automatic && is_stiff(surface));
    });
    const auto listed = [](const auto& surface) { return surface.stiff && bounded(surface); };
    if (std::count_if(surfaces.begin(), surfaces.end(), listed) <= longest_list)
        return;
    for_each_in_parallel(surfaces,
                         [](auto& surface) { surface.stiff = surface.stiff && !bounded(surface); });
}

}  // namespace

void mark_stiff(Accuracy accuracy, LoweredScene& lowered)
{
    mark(accuracy, lowered.spheres);
    mark(accuracy, lowered.huge_spheres);
    mark(accuracy, lowered.planes);
    mark(accuracy, lowered.quadrics);
}

std::size_t count_stiff(const LoweredScene& lowered)
{
    const auto stiff = [](const auto& surfaces) {
        return static_cast<std::size_t>(
            std::count_if(surfaces.begin(), surfaces.end(), [](const auto& s) { return s.stiff; }));
    };
    return stiff(lowered.spheres) + stiff(lowered.huge_spheres) + stiff(lowered.planes) +
           stiff(lowered.quadrics);
}

void mark_finished(Accuracy accuracy, SelfHits self_hits, LoweredScene& lowered)
{
    const bool all = accuracy == Accuracy::robust;
    lowered.finished.assign(lowered.material_index.size(), all ? 1 : 0);
    if (self_hits == SelfHits::exact)
        lowered.sharpened.assign(lowered.material_index.size(), abi::Sharpened::point);
    if (accuracy != Accuracy::automatic)
        return;
    if (!lowered.quadrics.empty())
        lowered.sharpened.resize(lowered.material_index.size(), abi::Sharpened::nothing);
    for_each_in_parallel(lowered.spheres, [&](const LoweredSphere& sphere) {
        if (is_stiff(sphere))
            lowered.finished[static_cast<std::size_t>(sphere.surface)] = 1;
    });
    for_each_in_parallel(lowered.quadrics, [&](const LoweredQuadric& quadric) {
        const int pieces = quadric.capped ? 3 : 1;
        if (is_stiff(quadric))
            std::fill_n(lowered.finished.begin() + quadric.surface, pieces, std::uint8_t{1});
        else
            std::fill_n(lowered.sharpened.begin() + quadric.surface, pieces, abi::Sharpened::all);
    });
}

}  // namespace packtrace
