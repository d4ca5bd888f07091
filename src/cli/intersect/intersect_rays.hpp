#pragma once

#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include "cli/intersect/ray_blocks.hpp"
#include "cli/intersect/ray_query.hpp"
#include "cli/output/text_output.hpp"

namespace packtrace::cli {

/// Answers every ray in turn, working on several blocks at once; memory does not grow with
/// their number. Throws FileError for the first wrong line.
template <class Real>
void intersect_rays(const Scene& scene, const RenderOptions& options, RayQuery query,
                    RayBounds bounds, RayBlocks& rays, TextOutput& output);

}  // namespace packtrace::cli
