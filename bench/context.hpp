#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace packtrace::bench {

/// What a measurement depends on besides the code it names: machine, compiler, flags of the
/// kernels, the commit that was built, and the machine's load when the program started.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> context();

/// The same as an object, by its names.
[[nodiscard]] nlohmann::ordered_json context_json();

/// Adds the machine's load now to a context, at the end of a measurement.
void add_load_after(nlohmann::ordered_json& context);

}  // namespace packtrace::bench
