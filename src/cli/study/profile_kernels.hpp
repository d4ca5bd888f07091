#pragma once

#include <iosfwd>

#include <packtrace/profile.hpp>

#include <nlohmann/json.hpp>

namespace packtrace::cli {

[[nodiscard]] double sum_of(const std::vector<KernelStage>& stages);

/// The inside of a frame: stages, rays, lanes and tests.
void print_kernels(std::ostream& to, const Profile& profile);

[[nodiscard]] nlohmann::ordered_json kernels_json(const KernelProfile& kernels);

}  // namespace packtrace::cli
