#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

// The recipe of a picture whose format has no room for text, in a file beside it.
namespace packtrace {

inline constexpr std::size_t longest_recipe = 2000;

/// Writes the file beside `picture`, which has these bytes. Throws FileError.
void write_recipe_beside(const std::filesystem::path& picture, std::span<const std::uint8_t> bytes,
                         const std::string& recipe);

/// The recipe beside `picture`; empty when there is none, or when the picture has other bytes now.
[[nodiscard]] std::string read_recipe_beside(const std::filesystem::path& picture);

}  // namespace packtrace
