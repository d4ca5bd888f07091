#pragma once

#include <filesystem>
#include <optional>

#include "lab/truth/truth.hpp"

namespace packtrace {

/// A truth's picture and seconds, in full precision, as a file of this machine's byte order. Throws
/// FileError.
void write_truth(const std::filesystem::path& file, const Truth& truth);

/// Nothing where there is no such file, or it is not whole.
[[nodiscard]] std::optional<Truth> read_truth(const std::filesystem::path& file);

}  // namespace packtrace
