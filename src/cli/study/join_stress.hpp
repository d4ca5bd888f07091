#pragma once

#include <string>
#include <vector>

namespace packtrace::cli {

/// The JSON of `stress --json`, of files that `stress --json --shard` wrote. Throws
/// std::runtime_error where one is missing or of other work.
[[nodiscard]] std::string join_stress(const std::vector<std::string>& parts);

}  // namespace packtrace::cli
