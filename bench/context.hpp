#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace packtrace::bench {

/// The conditions of a measurement: machine, compiler, flags of the kernels, commit, and the
/// machine's load when the program started.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> context();

/// The same as a JSON object.
[[nodiscard]] nlohmann::ordered_json context_json();

/// Adds the machine's present load to a context, at the end of a measurement.
void add_load_after(nlohmann::ordered_json& context);

}  // namespace packtrace::bench
