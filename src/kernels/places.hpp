#pragma once

#include "kernels/regroup.hpp"

// Rays sorted by where they lead, so that neighbours run together: hits of a tile that lie at
// all depths become bundles from the light.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Places are told apart by this many slices an axis.
inline constexpr int place_slices = 8;
inline constexpr int place_keys = place_slices * place_slices * place_slices;

/// Three bits with two zeros between each.
constexpr unsigned spread_slice(unsigned slice)
{
    return (slice & 1u) | (slice & 2u) << 2 | (slice & 4u) << 4;
}

/// A place a unit of the direction along each ray, as a number that is near for near places.
template <class Real>
class PlaceKeys {
public:
    PlaceKeys(const RayGroup<Real>& group, std::uint32_t cells) : group_(group)
    {
        float high[3] = {-no_end, -no_end, -no_end};
        for_each_active(group, cells, [&](int ray) {
            for (int axis = 0; axis < 3; ++axis) {
                const float at = place(axis, ray);
                low_[axis] = at < low_[axis] ? at : low_[axis];
                high[axis] = at > high[axis] ? at : high[axis];
            }
        });
        for (int axis = 0; axis < 3; ++axis) {
            const float size = high[axis] - low_[axis];
            const bool sliced = size > 0.0f && size < open_axis;
            scale_[axis] = sliced ? 0.999f * static_cast<float>(place_slices) / size : 0.0f;
        }
    }

    unsigned operator()(int ray) const
    {
        unsigned key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float slice = (place(axis, ray) - low_[axis]) * scale_[axis];
            // Also false for NaN.
            if (slice >= 0.0f && slice < static_cast<float>(place_slices))
                key |= spread_slice(static_cast<unsigned>(slice)) << axis;
        }
        return key;
    }

private:
    float place(int axis, int ray) const
    {
        return static_cast<float>(group_.org[axis][ray] + group_.dir[axis][ray]);
    }

    const RayGroup<Real>& group_;
    float low_[3] = {no_end, no_end, no_end};
    float scale_[3];
};

/// Copies the active rays of `cells` into `sorted`, in the order of their places.
template <class Real>
inline void sort_by_place(const RayGroup<Real>& group, std::uint32_t cells,
                          Regrouped<Real>& sorted)
{
    const PlaceKeys<Real> key(group, cells);
    std::uint16_t keys[group_rays];
    std::uint16_t start[place_keys + 1] = {};
    for_each_active(group, cells, [&](int ray) {
        keys[ray] = static_cast<std::uint16_t>(key(ray));
        ++start[keys[ray] + 1];
    });
    for (int i = 0; i < place_keys; ++i)
        start[i + 1] = static_cast<std::uint16_t>(start[i + 1] + start[i]);
    const int count = start[place_keys];
    for_each_active(group, cells, [&](int ray) {
        const int at = start[keys[ray]]++;
        copy_ray(sorted.rays, at, group, ray);
        sorted.from[at] = static_cast<std::uint8_t>(ray);
    });
    sorted.cells = (count + cell_rays - 1) / cell_rays;
    for (int cell = 0; cell < group_cells; ++cell)
        sorted.rays.active[cell] = cell < sorted.cells ? 0xffff : 0;
    if (count % cell_rays != 0)
        pad_cell(sorted.rays, count / cell_rays, count % cell_rays);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
