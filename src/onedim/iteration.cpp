#include "onedim/intensity.hpp"
#include "onedim/solvers.hpp"

namespace packtrace::onedim {
namespace {

// What leaves a surface on the side it faces.
Intensity shine(const Surface& surface, Intensity in_front, Intensity behind)
{
    return surface.reflectance * in_front + surface.translucence * behind + surface.emission;
}

bool assign(Intensity& ray, Intensity value)
{
    const bool changed = ray != value;
    ray = value;
    return changed;
}

bool sweep_left(std::span<const Surface> system, Rays& rays)
{
    bool changed = false;
    for (std::size_t i = system.size(); i-- > 0;) {
        const Surface& next = system[i];
        const Intensity beyond = rays.left[i + 1];
        changed |= assign(rays.left[i], next.direction == Direction::towards
                                            ? shine(next, rays.right[i], beyond)
                                            : beyond);
    }
    return changed;
}

bool sweep_right(std::span<const Surface> system, Rays& rays)
{
    bool changed = false;
    for (std::size_t i = 1; i <= system.size(); ++i) {
        const Surface& last = system[i - 1];
        const Intensity before = rays.right[i - 1];
        changed |=
            assign(rays.right[i],
                   last.direction == Direction::away ? shine(last, rays.left[i], before) : before);
    }
    return changed;
}

}  // namespace

std::size_t iterate(std::span<const Surface> system, Rays& rays)
{
    rays.left.assign(system.size() + 1, Intensity::none);
    rays.right.assign(system.size() + 1, Intensity::none);
    std::size_t sweeps = 0;
    for (bool changed = true; changed; ++sweeps) {
        const bool left_changed = sweep_left(system, rays);
        const bool right_changed = sweep_right(system, rays);
        changed = left_changed || right_changed;
    }
    return sweeps;
}

}  // namespace packtrace::onedim
