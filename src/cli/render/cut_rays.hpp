#pragma once

#include <string>

#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

namespace packtrace::cli {

/// Says on standard error how many rays `--min-weight` left out of what went to `output`, and how
/// far off that can make a pixel; nothing where all rays are traced.
void print_cut_rays(const std::string& output, const Scene& scene, const RenderOptions& options,
                    const CutRays& cut);

}  // namespace packtrace::cli
