#pragma once

#include "cli/intersect/ray_csv.hpp"
#include "core/read_file.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

// A file of rays, read block by block, and cut into ranges that machines or ranks share.
namespace packtrace::cli {

/// Whole lines of a file of rays that follow each other.
struct RayRange {
    std::uint64_t begin = 0;  ///< bytes
    std::uint64_t end = std::numeric_limits<std::uint64_t>::max();
    std::size_t first_line = 1;   ///< number of its first line in the file
    std::uint64_t first_ray = 0;  ///< number of its first ray
    RayFormat format = {};        ///< of what stands before it, if known
};

/// Reads a file, or its bytes from `begin` to `end`, in blocks of whole lines, so that its length
/// costs no memory. `-` is standard input.
class TextBlocks {
public:
    /// Also the longest line allowed.
    static constexpr std::size_t largest = std::size_t{1} << 16;

    /// Throws FileError.
    explicit TextBlocks(const std::string& file, std::uint64_t begin = 0,
                        std::uint64_t end = std::numeric_limits<std::uint64_t>::max());

    /// The next block, at most `largest` bytes; empty at the end. Throws FileError.
    [[nodiscard]] std::string next();

    /// The file's name as messages show it.
    [[nodiscard]] const std::string& name() const
    {
        return name_;
    }

private:
    std::string name_;
    OpenFile file_;
    std::uint64_t left_;  // bytes of the range that have not been read yet
    std::string begun_;   // the start of a line whose end has not been read yet
    std::size_t lines_ = 0;
};

/// Some lines of a file of rays, with all that is needed to read them apart from the others.
struct RayBlock {
    std::string text;  ///< empty: the file is at its end
    RayFormat format;
    std::size_t first_line = 1;
    std::uint64_t first_ray = 0;
    std::uint64_t rays = 0;  ///< in it
};

/// Cuts a file of rays into blocks that can be read in any order.
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

/// Lines and rays of a range, for those after it.
struct RayCount {
    std::uint64_t lines = 0;
    std::uint64_t rays = 0;
};

/// The length of a file of rays. Throws FileError, also for what is no regular file: a pipe can't
/// be cut into ranges.
[[nodiscard]] std::uint64_t ray_file_size(const std::string& file);

/// Of all of a file of rays up to 64 MiB, else of 1024 pieces of 64 KiB, spread evenly from its
/// beginning to its end: parts of a large file are made without reading all of it.
[[nodiscard]] std::uint32_t ray_file_checksum(const std::string& file);

/// Part `index` of `count` parts of about the same length; numbers and format are not set.
[[nodiscard]] RayRange cut_rays(const std::string& file, std::uint64_t index, std::uint64_t count);

/// The same with its numbers and format, for which what stands before it is read.
[[nodiscard]] RayRange numbered_rays(const std::string& file, std::uint64_t index,
                                     std::uint64_t count);

/// What the file's first ray or header says of its format; without columns where there is none.
[[nodiscard]] RayFormat format_of_rays(const std::string& file);

/// Counts without looking at numbers. `range` may lack its own numbers.
[[nodiscard]] RayCount count_rays(const std::string& file, const RayRange& range);

}  // namespace packtrace::cli
