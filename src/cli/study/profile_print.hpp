#pragma once

#include <packtrace/profile.hpp>

#include <nlohmann/json.hpp>

#include <iosfwd>
#include <string>
#include <vector>

namespace packtrace::cli {

void print_profile(std::ostream& to, const std::string& scene, const Profile& profile);

[[nodiscard]] nlohmann::ordered_json profile_json(const std::string& scene, const Profile& profile);

/// Events for chrome://tracing and Perfetto, with one row per thread.
[[nodiscard]] nlohmann::ordered_json trace_json(const std::vector<TileSpan>& tiles);

/// Prints the work inside a frame: stages, rays, lanes and tests.
void print_kernels(std::ostream& to, const Profile& profile);

[[nodiscard]] nlohmann::ordered_json kernels_json(const KernelProfile& kernels);

}  // namespace packtrace::cli
