#pragma once

#include <optional>
#include <string>

#include "cli/render/render_arguments.hpp"

namespace packtrace::cli {

/// Adds `--region`.
void add_region_option(CLI::App& command, RenderArguments& arguments);

/// Throws CLI::ValidationError where a region can't be together with another option.
void check_region_options(const RenderArguments& arguments);

/// What of the scene's picture is rendered. Throws CLI::ValidationError for a region outside it.
[[nodiscard]] std::optional<Region> region_of(const RenderArguments& arguments, const Scene& scene);

}  // namespace packtrace::cli
