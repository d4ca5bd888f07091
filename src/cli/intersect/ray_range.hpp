#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "cli/intersect/ray_format.hpp"

namespace packtrace::cli {

/// Whole lines of a file of rays that follow each other.
struct RayRange {
    std::uint64_t begin = 0;  ///< bytes
    std::uint64_t end = std::numeric_limits<std::uint64_t>::max();
    std::size_t first_line = 1;   ///< number of its first line in the file
    std::uint64_t first_ray = 0;  ///< number of its first ray
    RayFormat format = {};        ///< of what stands before it, if known
};

/// Lines and rays of a range, for those after it.
struct RayCount {
    std::uint64_t lines = 0;
    std::uint64_t rays = 0;
};

/// The length of a file of rays. Throws FileError, also for what is no regular file: a pipe can't
/// be cut into ranges.
[[nodiscard]] std::uint64_t ray_file_size(const std::string& file);

/// The first line that begins at `place` or after it.
[[nodiscard]] std::uint64_t next_line(const std::string& file, std::uint64_t place);

/// Part `index` of `count` parts of about the same length; numbers and format are not set.
[[nodiscard]] RayRange cut_rays(const std::string& file, std::uint64_t index, std::uint64_t count);

/// What the file's first ray or header says of its format; without columns where there is none.
[[nodiscard]] RayFormat format_of_rays(const std::string& file);

/// Counts without looking at numbers. `range` may lack its own numbers.
[[nodiscard]] RayCount count_rays(const std::string& file, const RayRange& range);

}  // namespace packtrace::cli
