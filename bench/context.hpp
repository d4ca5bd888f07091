#pragma once

#include <string>
#include <utility>
#include <vector>

namespace packtrace::bench {

/// What a measurement depends on besides the code it names: machine, compiler, flags, commit.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> context();

}  // namespace packtrace::bench
