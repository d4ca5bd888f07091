#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <packtrace/intersect.hpp>

#include <tbb/enumerable_thread_specific.h>

#include "cli/intersect/hit_rows.hpp"
#include "cli/intersect/ray_blocks.hpp"
#include "cli/intersect/ray_query.hpp"
#include "cli/intersect/ray_reader.hpp"

namespace packtrace::cli {

/// The line above all rows.
[[nodiscard]] std::string_view header_of(RayQuery query, RayBounds bounds);

/// Turns blocks of rays into rows of hits; several threads may do so at once.
template <class Real>
class BlockTracer {
public:
    /// Throws as RayScene does.
    BlockTracer(const Scene& scene, const RenderOptions& options, RayQuery query, RayBounds bounds);

    /// Throws FileError for a wrong line.
    [[nodiscard]] std::string rows_of(const RayBlock& block);

private:
    // The memory a thread needs for a block, kept for its next one.
    struct Scratch {
        RayArrays<Real> rays;
        std::vector<Real> t, normal_x, normal_y, normal_z;
        std::vector<std::int32_t> object;
        std::vector<std::uint8_t> mask;
        std::vector<HitBounds> bounds;
    };

    void append_closest(std::string& rows, Scratch& s) const;
    void append_all(std::string& rows, std::uint64_t first_ray, Scratch& s) const;
    void append_any(std::string& rows, Scratch& s) const;

    RayScene<Real> scene_;
    HitRows rows_;
    RayQuery query_;
    RayBounds bounds_;
    tbb::enumerable_thread_specific<Scratch> scratch_;
};

}  // namespace packtrace::cli
