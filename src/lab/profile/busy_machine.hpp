#pragma once

#include <string>
#include <vector>

#include <packtrace/profile.hpp>

namespace packtrace {

/// What of a profile was measured on too busy a machine, a sentence each. Figures that vary from
/// turn to turn by more than a tenth of a frame, and sums that are more than that off their whole,
/// are no figures.
[[nodiscard]] std::vector<std::string> busy_lines(const Profile& profile);

}  // namespace packtrace
