#pragma once

#include "kernels/geometry/sphere_list.hpp"

// Sorts lists of spheres by their distance from a shared ray origin, so that a packet skips the
// spheres behind all its hits.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The search for closest hits checks once per `sorted_step` spheres whether the rest of the list
/// is behind. Shorter lists are not worth sorting; lists with more than `most_sorted_spheres` take
/// too long to sort.
inline constexpr int sorted_step = 4;
inline constexpr int most_sorted_spheres = 255;

/// A lower bound of the distance of a packet of spheres from the shared origin, reduced by far more
/// than the rounding error of a t.
inline vreal<float> least_distance(const SphereFilters& list, int first)
{
    const Vec3v<float> w{load(list.x + first), load(list.y + first), load(list.z + first)};
    const vreal<float> zero(0.0f);
    const vreal<float> outer = sqrt(max(load(list.bounds.outer2 + first), zero));
    const vreal<float> distance = nmadd(vreal<float>(1.0f + roundoffs(8.0f)), outer,
                                        sqrt(dot(w, w)) * vreal<float>(1.0f - roundoffs(32.0f)));
    return select(distance > zero, distance, zero);
}

/// Fills `rank` with the sorted positions of a list's spheres, and finds their distances. Spheres
/// at equal distance keep their order.
inline void rank_by_distance(std::uint8_t (&rank)[most_sorted_spheres], SphereFilters& list)
{
    for (int first = 0; first < list.count; first += lanes<float>)
        store(list.distance + first, least_distance(list, first));
    store(list.distance + list.count, vreal<float>(__builtin_inff()));
    std::uint8_t as_near[most_sorted_spheres] = {};
    for (int i = 0; i < list.count; ++i) {
        const vreal<float> own(list.distance[i]);
        int nearer = 0;
        for (int first = 0; first < list.count; first += lanes<float>)
            nearer += __builtin_popcount(bits(load(list.distance + first) < own));
        rank[i] = static_cast<std::uint8_t>(nearer + as_near[nearer]++);
    }
}

template <class Value>
inline void reorder(Value* values, const std::uint8_t (&rank)[most_sorted_spheres], int count)
{
    Value before[most_sorted_spheres];
    for (int i = 0; i < count; ++i)
        before[i] = values[i];
    for (int i = 0; i < count; ++i)
        values[rank[i]] = before[i];
}

/// Sorts a list, unless it is too short or too long.
inline void sort_by_distance(SphereFilters& list)
{
    if (list.count <= sorted_step || list.count > most_sorted_spheres)
        return;
    std::uint8_t rank[most_sorted_spheres];
    rank_by_distance(rank, list);
    for (float** const values : arrays_of(list).of)
        reorder(*values, rank, list.count);
    reorder(list.surface, rank, list.count);
    list.sorted = true;
}

/// Whether the spheres of a sorted list from `i` on are behind `t` for all rays.
inline bool are_behind(const SphereFilters& list, int i, const vreal<float>& t,
                       const RayScale& scale)
{
    return all(t * scale.length < vreal<float>(list.distance[i]));
}

/// The same for any list, checked at every sorted_step-th sphere.
inline bool rest_is_behind(const SphereFilters& list, int i, const vreal<float>& t,
                           const RayScale& scale)
{
    return i % sorted_step == sorted_step - 1 && list.sorted && are_behind(list, i, t, scale);
}

/// The number of spheres in a list without those at its end that are behind `t` for all rays.
inline int count_before(const SphereFilters& list, const vreal<float>& t, const RayScale& scale)
{
    if (!list.sorted)
        return list.count;
    int before = 0;
    int behind = list.count;
    while (before < behind) {
        const int middle = (before + behind) / 2;
        if (are_behind(list, middle, t, scale))
            behind = middle;
        else
            before = middle + 1;
    }
    return before;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
