#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace packtrace::cli {

/// Generations that tables show apart; the last of them stands for all further ones, too.
inline constexpr int depths_shown = 5;

/// `deepest` is that of all rows.
[[nodiscard]] inline std::string depth_name(int depth, int deepest)
{
    const bool more = depth == depths_shown - 1 && deepest > depth;
    return "depth " + std::to_string(depth) + (more ? " on" : "");
}

template <class Row>
[[nodiscard]] int deepest_of(const std::vector<Row>& rows)
{
    int depth = 0;
    for (const Row& row : rows)
        depth = std::max(depth, row.depth);
    return depth;
}

/// Rows of generations that are not shown apart, added by `add(to, row)` where `same` says they
/// are of one kind.
template <class Row, class Same, class Add>
[[nodiscard]] std::vector<Row> with_deep_ones_joined(const std::vector<Row>& rows, const Same& same,
                                                     const Add& add)
{
    std::vector<Row> joined;
    for (Row row : rows) {
        row.depth = std::min(row.depth, depths_shown - 1);
        const auto found = std::find_if(joined.begin(), joined.end(), [&](const Row& other) {
            return other.depth == row.depth && same(other, row);
        });
        if (found == joined.end())
            joined.push_back(row);
        else
            add(*found, row);
    }
    return joined;
}

}  // namespace packtrace::cli
