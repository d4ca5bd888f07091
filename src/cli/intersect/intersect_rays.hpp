#pragma once

#include <functional>
#include <string_view>

#include "cli/intersect/block_tracer.hpp"
#include "cli/intersect/ray_blocks.hpp"

namespace packtrace::cli {

/// Takes the rows of one block after the other, in order.
using TakeRows = std::function<void(const RayBlock& block, std::string_view rows)>;

/// Answers every ray in turn, working on several blocks at once; memory does not grow with
/// their number. Throws FileError for the first wrong line.
template <class Real>
void intersect_rays(BlockTracer<Real>& tracer, RayBlocks& rays, const TakeRows& take);

}  // namespace packtrace::cli
