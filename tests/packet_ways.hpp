#pragma once

#include "catch.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace packtrace::test {

/// Options for every instruction set of this machine, with list and with bvh traversal, in one
/// accuracy.
[[nodiscard]] inline std::vector<RenderOptions> packet_ways(Accuracy accuracy = Accuracy::exact)
{
    std::vector<RenderOptions> ways;
    for (const IsaInfo& isa : list_isas())
        for (const Traversal traversal : {Traversal::list, Traversal::tree})
            if (isa.supported)
                ways.push_back({.isa = isa.name, .accuracy = accuracy, .traversal = traversal});
    return ways;
}

/// The largest difference over all channels of all pixels.
template <class Real>
[[nodiscard]] double largest_difference(const Image<Real>& image, const Image<double>& truth)
{
    REQUIRE(image.rgb.size() == truth.rgb.size());
    double most = 0.0;
    for (std::size_t i = 0; i < truth.rgb.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(image.rgb[i]) - truth.rgb[i]));
    return most;
}

}  // namespace packtrace::test
