#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "cli/intersect/ray_format.hpp"
#include "cli/intersect/ray_range.hpp"
#include "cli/intersect/text_blocks.hpp"

namespace packtrace::cli {

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

}  // namespace packtrace::cli
