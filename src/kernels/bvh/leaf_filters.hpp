#pragma once

#include "kernels/bvh/leaf.hpp"
#include "kernels/geometry/kinds.hpp"

// Error bounds of the objects in a BVH's runs. Computing them takes longer than testing a packet,
// but they depend only on how far the rays of a bundle start from the objects. So they are kept for
// the next packets and bundles.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The bounds that were computed last, by the objects' numbers in runs.
struct LeafFilters {
    static constexpr int slots = 256;

    union Filter {
        QuadricFilter quadric;
        PolygonFilter polygon;
    };

    const std::int32_t* run_surfaces;  ///< of the BVH that the bounds are for
    std::int32_t number[slots];        ///< -1: empty
    float length[slots];               ///< RayBundle::length that they hold for
    Filter filter[slots];

    /// Removes all bounds. The next ones are for another BVH.
    void begin(const std::int32_t* of)
    {
        run_surfaces = of;
        for (std::int32_t& each : number)
            each = -1;
    }

    [[nodiscard]] QuadricFilter& at(int slot, const abi::QuadricRecord<float>&)
    {
        return filter[slot].quadric;
    }
    [[nodiscard]] PolygonFilter& at(int slot, const abi::PolygonRecord<float>&)
    {
        return filter[slot].polygon;
    }
};

/// Bounds are computed for a length that is larger than the bundle's by length_in_store. Bundles
/// use them until they would be too wide, by more than widest_use.
inline constexpr float length_in_store = 1.25f;
inline constexpr float widest_use = 2.5f;

/// The bounds of object `number` of the runs for a bundle's rays. They are valid until the next
/// call.
template <template <class> class Record>
inline const auto& leaf_filter(int number, const Record<float>& record, const Record<double>& wide,
                               const RayBundle<float>& bundle)
{
    LeafFilters& filters = *bundle.filters;
    const int slot = number % LeafFilters::slots;
    auto& filter = filters.at(slot, record);
    float& length = filters.length[slot];
    if (filters.number[slot] == number && length >= bundle.length &&
        length <= widest_use * bundle.length)
        return filter;
    filters.number[slot] = number;
    length = length_in_store * bundle.length;
    Origins origins;
    for (int axis = 0; axis < 3; ++axis)
        origins.center[axis] = record.bound[axis];
    origins.radius = length;
    filter = certain_form<Origin::any>(record, wide, origins);
    return filter;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
