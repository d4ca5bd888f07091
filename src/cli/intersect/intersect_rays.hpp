#pragma once

#include "cli/intersect/hit_rows.hpp"
#include "cli/intersect/ray_csv.hpp"
#include "cli/intersect/ray_file.hpp"
#include <packtrace/intersect.hpp>

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace packtrace::cli {

/// Turns blocks of rays into rows of hits. Thread-safe.
template <class Real>
class BlockTracer {
public:
    /// Throws as RayScene does.
    BlockTracer(const Scene& scene, const RenderOptions& options, RayQuery query, RayBounds bounds);

    /// Throws FileError for a wrong line.
    [[nodiscard]] std::string rows_of(const RayBlock& block);

private:
    // The memory of a thread for a block, reused for its next block.
    struct Scratch {
        RayColumns<Real> rays;
        HitColumns<Real> hits;
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

/// Receives the rows of the blocks, in order.
using TakeRows = std::function<void(const RayBlock& block, std::string_view rows)>;

/// Traces all rays, several blocks at once. Memory does not grow with the number of blocks. Throws
/// FileError for the first wrong line.
template <class Real>
void intersect_rays(BlockTracer<Real>& tracer, RayBlocks& rays, const TakeRows& take);

}  // namespace packtrace::cli
