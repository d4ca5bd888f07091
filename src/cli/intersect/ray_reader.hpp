#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include <packtrace/intersect.hpp>

#include "cli/intersect/ray_format.hpp"

namespace packtrace::cli {

/// Rays by column, as RaysView wants them.
template <class Real>
struct RayArrays {
    std::array<std::vector<Real>, most_ray_columns> columns;

    [[nodiscard]] RaysView<Real> view() const
    {
        const auto& c = columns;
        return {c[0].data(), c[1].data(), c[2].data(), c[3].data(), c[4].data(),
                c[5].data(), c[6].data(), c[7].data(), c[0].size()};
    }
};

/// Replaces `rays` by those of whole lines of a file, the first of which has the number
/// `first_line`. Throws FileError, `file:line:column: …`, for what is not a ray.
template <class Real>
void read_rays(const RayFormat& format, std::string_view text, std::size_t first_line,
               RayArrays<Real>& rays);

}  // namespace packtrace::cli
