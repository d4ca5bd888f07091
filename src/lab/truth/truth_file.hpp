#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lab/truth/truth.hpp"

namespace packtrace {

/// A truth's key, its picture and its seconds, in full precision and this machine's byte order,
/// with a checksum over all of them. Throws FileError.
void write_truth(const std::filesystem::path& file, const std::string& key, const Truth& truth);

/// Nothing where there is no such file, it is not whole, a byte of it has changed, or it has
/// another key.
[[nodiscard]] std::optional<Truth> read_truth(const std::filesystem::path& file,
                                              const std::string& key);

}  // namespace packtrace
