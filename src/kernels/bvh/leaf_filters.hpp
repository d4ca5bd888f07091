#pragma once

#include "kernels/bvh/leaf.hpp"
#include "kernels/geometry/kinds.hpp"

// Error bounds of the objects of a hierarchy's runs. They take longer to find than a packet takes
// to be tested, and hang on little: on how far the rays of a bundle start from the objects. So they
// are kept for the next packets and bundles.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The bounds that were found last, by the objects' numbers in runs.
struct LeafFilters {
    static constexpr int places = 256;

    union Filter {
        QuadricFilter quadric;
        PolygonFilter polygon;
    };

    const std::int32_t* run_surfaces;  ///< of the hierarchy they are of
    std::int32_t number[places];       ///< -1: none
    float length[places];              ///< RayBundle::length that they hold for
    Filter filter[places];

    /// Forgets all; those to come are of another hierarchy.
    void begin(const std::int32_t* of)
    {
        run_surfaces = of;
        for (std::int32_t& each : number)
            each = -1;
    }

    [[nodiscard]] QuadricFilter& at(int place, const abi::QuadricRecord<float>&)
    {
        return filter[place].quadric;
    }
    [[nodiscard]] PolygonFilter& at(int place, const abi::PolygonRecord<float>&)
    {
        return filter[place].polygon;
    }
};

/// Bounds are found for rays from somewhat further off than a bundle's, and serve others until they
/// are much too wide.
inline constexpr float length_in_store = 1.25f;
inline constexpr float widest_use = 2.5f;

/// The bounds of object `number` of the runs for a bundle's rays. They hold until it is asked for
/// another's.
template <template <class> class Record>
inline const auto& leaf_filter(int number, const Record<float>& record, const Record<double>& wide,
                               const RayBundle<float>& bundle)
{
    LeafFilters& filters = *bundle.filters;
    const int place = number % LeafFilters::places;
    auto& filter = filters.at(place, record);
    float& length = filters.length[place];
    if (filters.number[place] == number && length >= bundle.length &&
        length <= widest_use * bundle.length)
        return filter;
    filters.number[place] = number;
    length = length_in_store * bundle.length;
    Origins origins;
    for (int axis = 0; axis < 3; ++axis)
        origins.center[axis] = record.bound[axis];
    origins.radius = length;
    filter = certain_form<false>(record, wide, origins);
    return filter;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
