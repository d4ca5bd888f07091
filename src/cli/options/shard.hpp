#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace packtrace::cli {

/// One of `count` parts that work is cut into, for machines that know nothing of each other.
struct Shard {
    int index = 0;  ///< from 0
    int count = 1;

    /// "2/8"
    [[nodiscard]] std::string text() const
    {
        return std::to_string(index) + "/" + std::to_string(count);
    }
};

/// Reads "I/N"; nothing where it is none.
[[nodiscard]] std::optional<Shard> parse_shard(const std::string& text);

/// `--shard`; `what` says what it cuts.
CLI::Option* add_shard_option(CLI::App& command, std::optional<std::string>& shard,
                              const std::string& what);

}  // namespace packtrace::cli
