#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cli/options/shard.hpp"

namespace packtrace::cli {

/// The first line of a part of a file of hits, so that parts of different work are not joined.
struct PartHead {
    Shard shard;
    std::string recipe;  ///< what the hits depend on, the same for all parts

    static constexpr std::string_view begin = "# packtrace part ";

    [[nodiscard]] std::string line() const
    {
        return std::string(begin) + shard.text() + " of " + recipe + "\n";
    }
    /// Of a line without its end; nothing for any other line.
    [[nodiscard]] static std::optional<PartHead> parse(std::string_view line)
    {
        if (!line.starts_with(begin))
            return std::nullopt;
        line.remove_prefix(begin.size());
        const std::size_t end = line.find(" of ");
        const std::optional<Shard> shard = parse_shard(std::string(line.substr(0, end)));
        if (!shard || end == std::string_view::npos)
            return std::nullopt;
        return PartHead{*shard, std::string(line.substr(end + 4))};
    }
};

}  // namespace packtrace::cli
