#pragma once

#include "cli/intersect/ray_csv.hpp"
#include "core/read_file.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

// Reads a file of rays block by block, and divides it into ranges for machines or ranks.
namespace packtrace::cli {

/// A range of whole, consecutive lines of a file of rays.
struct RayRange {
    std::uint64_t begin = 0;  ///< bytes
    std::uint64_t end = std::numeric_limits<std::uint64_t>::max();
    std::size_t first_line = 1;   ///< number of its first line in the file
    std::uint64_t first_ray = 0;  ///< number of its first ray
    RayFormat format = {};        ///< from the lines before the range, if known
};

/// Reads a file, or its bytes from `begin` to `end`, in blocks of whole lines. Memory does not grow
/// with the file. `-` is standard input.
class TextBlocks {
public:
    /// The largest block, and so the longest line, in bytes.
    static constexpr std::size_t largest = std::size_t{1} << 16;

    /// Throws FileError.
    explicit TextBlocks(const std::string& file, std::uint64_t begin = 0,
                        std::uint64_t end = std::numeric_limits<std::uint64_t>::max());

    /// The next block, at most `largest` bytes; empty at the end. Throws FileError.
    [[nodiscard]] std::string next();

    /// The file's name in messages.
    [[nodiscard]] const std::string& name() const
    {
        return name_;
    }

private:
    std::string name_;
    OpenFile file_;
    std::uint64_t left_;  // bytes of the range that are not yet read
    std::string begun_;   // the start of a line whose end is not yet read
    std::size_t lines_ = 0;
};

/// Some lines of a file of rays, with everything needed to read them independently of other blocks.
struct RayBlock {
    std::string text;  ///< empty at the end of the file
    RayFormat format;
    std::size_t first_line = 1;
    std::uint64_t first_ray = 0;
    std::uint64_t rays = 0;  ///< number of rays in the block
};

/// Divides a file of rays into blocks that can be processed in any order.
class RayBlocks {
public:
    /// Throws FileError.
    explicit RayBlocks(const std::string& file, const RayRange& range = {});

    /// Throws FileError.
    [[nodiscard]] RayBlock next();

private:
    TextBlocks blocks_;
    RayFormat format_;
    std::size_t line_ = 1;
    std::uint64_t ray_ = 0;
};

/// The numbers of lines and rays of a range, to number the ranges after it.
struct RayCount {
    std::uint64_t lines = 0;
    std::uint64_t rays = 0;
};

/// The length of a file of rays, in bytes. Throws FileError, also if it is not a regular file,
/// because a pipe cannot be divided into ranges.
[[nodiscard]] std::uint64_t ray_file_size(const std::string& file);

/// A checksum of a file of rays: of all of it up to 64 MiB, otherwise of 1024 pieces of 64 KiB,
/// distributed evenly from its beginning to its end. So parts of a large file are processed without
/// reading all of it.
[[nodiscard]] std::uint32_t ray_file_checksum(const std::string& file);

/// Part `index` of `count` parts of about equal length. Numbers and format are not set.
[[nodiscard]] RayRange cut_rays(const std::string& file, std::uint64_t index, std::uint64_t count);

/// Part `index` of `count`, with numbers and format. To find them, it reads the file up to the
/// part.
[[nodiscard]] RayRange numbered_rays(const std::string& file, std::uint64_t index,
                                     std::uint64_t count);

/// The format of the file, from its first ray or header; without columns if it has neither.
[[nodiscard]] RayFormat format_of_rays(const std::string& file);

/// Counts lines and rays without parsing numbers. Numbers of `range` need not be set.
[[nodiscard]] RayCount count_rays(const std::string& file, const RayRange& range);

}  // namespace packtrace::cli
