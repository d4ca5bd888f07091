#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "study/truth.hpp"

namespace packtrace {

/// Fowler, Noll and Vo's hash FNV-1a of 64 bits.
[[nodiscard]] std::uint64_t hash_of(std::string_view bytes,
                                    std::uint64_t start = 0xcbf29ce484222325);

/// A truth's picture and seconds, in full precision, as a file of this machine's byte order. Throws
/// FileError.
void write_truth(const std::filesystem::path& file, const Truth& truth);

/// Nothing where there is no such file, or it is not whole.
[[nodiscard]] std::optional<Truth> read_truth(const std::filesystem::path& file);

}  // namespace packtrace
