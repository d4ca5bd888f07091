#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "cli/intersect/csv_lines.hpp"

namespace packtrace::cli {

inline constexpr std::size_t most_ray_columns = 8;
inline constexpr std::array<std::string_view, most_ray_columns> ray_columns{
    "ox", "oy", "oz", "dx", "dy", "dz", "t_min", "t_max"};

/// How a file writes its rays; its first line tells.
struct RayFormat {
    std::string file;             ///< its name, as messages show it
    std::size_t columns = 0;      ///< 6 or 8; 0 until the first line has been read
    std::size_t first_line = 0;   ///< the number of that line
    std::size_t header_line = 0;  ///< the same if it is a header, else 0
};

/// Learns the format from the file's first line. Throws FileError for a line that has neither
/// 6 nor 8 columns.
void learn(RayFormat& format, const CsvLine& first);

/// Throws FileError, `file:line:column: message`. `at` points into the line.
[[noreturn]] void fail_at(const RayFormat& format, const CsvLine& line, const char* at,
                          const std::string& message);

/// Cuts the next field off `rest`, without the blanks around it.
[[nodiscard]] std::string_view cut_field(std::string_view& rest);

}  // namespace packtrace::cli
