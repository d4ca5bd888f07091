#include "onedim/order.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace packtrace::onedim {
namespace {

// Lengths of this many words and more are not told apart.
constexpr std::size_t longest = 1024;

std::size_t bucket(std::span<const Surface> system)
{
    return std::min((system.size() + 7) / 8, longest);
}

}  // namespace

std::vector<std::uint32_t> order_by_length(const Systems& systems)
{
    // A counting sort: the systems of each length, then where each length's place begins.
    std::array<std::uint32_t, longest + 1> place{};
    for (std::size_t k = 0; k < systems.size(); ++k)
        ++place[bucket(systems[k])];
    std::exclusive_scan(place.begin(), place.end(), place.begin(), std::uint32_t{0});

    std::vector<std::uint32_t> order(systems.size());
    for (std::size_t k = 0; k < systems.size(); ++k)
        order[place[bucket(systems[k])]++] = static_cast<std::uint32_t>(k);
    return order;
}

}  // namespace packtrace::onedim
