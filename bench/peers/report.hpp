#pragma once

#include "agreement.hpp"
#include "race.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace packtrace::peers {

/// The results of one scene and kind of rays.
struct Outcome {
    std::string scene;
    std::size_t objects = 0;
    std::string kind;
    std::vector<Result> results;
    std::optional<Agreement> agreement;                ///< of closest hits
    std::optional<std::size_t> occlusion_differences;  ///< of shadow rays
};

[[nodiscard]] nlohmann::ordered_json to_json(const Outcome& outcome);
void print(const Outcome& outcome);
void print_builds(const nlohmann::ordered_json& builds);

}  // namespace packtrace::peers
