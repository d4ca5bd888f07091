#pragma once

#include "cli/options/validators.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace packtrace::cli {

/// One of `count` parts of the work, for machines that do not communicate.
struct Shard {
    int index = 0;  ///< from 0
    int count = 1;

    /// "2/8"
    [[nodiscard]] std::string text() const
    {
        return std::to_string(index) + "/" + std::to_string(count);
    }
};

/// Reads "I/N"; not set for other text.
[[nodiscard]] inline std::optional<Shard> parse_shard(const std::string& text)
{
    constexpr int most_shards = 1'000'000;
    const std::optional<std::array<int, 2>> numbers = parse_numbers<2>(text, '/');
    if (!numbers)
        return std::nullopt;
    const Shard shard{(*numbers)[0], (*numbers)[1]};
    if (shard.index < 0 || shard.index >= shard.count || shard.count > most_shards)
        return std::nullopt;
    return shard;
}

/// Adds `--shard`. `what` names the work that it divides.
inline CLI::Option* add_shard_option(CLI::App& command, std::optional<std::string>& shard,
                                     const std::string& what)
{
    return command.add_option("--shard", shard, what)
        ->check(parsed_by(parse_shard, "a shard such as 0/8, the first of eight, or 7/8, the last"))
        ->type_name("I/N");
}

/// The first line of a part of a file of hits. It prevents that parts of different work are joined.
struct PartHead {
    Shard shard;
    std::string recipe;  ///< everything that the hits depend on; equal for all parts

    static constexpr std::string_view begin = "# packtrace part ";

    [[nodiscard]] std::string line() const
    {
        return std::string(begin) + shard.text() + " of " + recipe + "\n";
    }
    /// Parses a line without its end. Not set for other lines.
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

/// The last line of a part. It prevents that truncated or changed parts are joined.
struct PartEnd {
    std::uint64_t bytes = 0;     ///< of the part, before this line
    std::uint32_t checksum = 0;  ///< of these bytes

    static constexpr std::string_view begin = "# packtrace part ends after ";
    static constexpr std::size_t longest = 100;

    [[nodiscard]] std::string line() const
    {
        return std::string(begin) + std::to_string(bytes) + " bytes of checksum " +
               std::to_string(checksum) + "\n";
    }
};

}  // namespace packtrace::cli
