#include "onedim/bitsliced.hpp"

#include <algorithm>

#include "onedim/group.hpp"
#include "onedim/order.hpp"

namespace packtrace::onedim {

void solve_bitsliced(const Systems& systems, const abi::OnedimTable& kernel,
                     std::span<Intensity> answers)
{
    const std::vector<std::uint32_t> order = order_by_length(systems);
    Group group(kernel);
    for (std::span<const std::uint32_t> left = order; !left.empty();) {
        const std::size_t count = std::min(left.size(), group.capacity());
        group.solve(systems, left.first(count), answers);
        left = left.subspan(count);
    }
}

}  // namespace packtrace::onedim
