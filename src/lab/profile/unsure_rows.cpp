#include "lab/profile/unsure_rows.hpp"

#include <cstddef>

namespace packtrace {

const std::vector<std::string>& unsure_causes()
{
    static const std::vector<std::string> names{"tangent", "order", "range", "clip", "magnitude"};
    static_assert(abi::cause_count == 5);
    return names;
}

void add_causes(const abi::WorkCounts& counts, UnsureCounts& sum)
{
    for (const auto& by_cause : counts.unsure)
        for (std::size_t cause = 0; cause < abi::cause_count; ++cause)
            sum[cause] += by_cause[cause];
}

std::vector<UnsureUse> unsure_rows(const std::vector<abi::WorkCounts>& counts)
{
    constexpr const char* rays[] = {"closest", "shadow"};
    static_assert(std::size(rays) == abi::role_count);
    std::vector<UnsureUse> rows;
    for (std::size_t depth = 0; depth < counts.size(); ++depth)
        for (std::size_t role = 0; role < abi::role_count; ++role)
            for (std::size_t cause = 0; cause < abi::cause_count; ++cause)
                if (const std::uint64_t count = counts[depth].unsure[role][cause]; count > 0)
                    rows.push_back(
                        {static_cast<int>(depth), rays[role], unsure_causes()[cause], count});
    return rows;
}

}  // namespace packtrace
