#pragma once

#include "dispatch/kernels.hpp"
#include "lower/buffered_scene.hpp"
#include "lower/prune.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/scene.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace packtrace::cli {

/// How float packets render a scene.
struct SceneFeatures {
    std::string kernel;             ///< name of the feature set
    bool in_registers = false;      ///< fused kernels trace paths in registers, without streams
    bool sorts_mirrored = false;    ///< mirrored rays of several tiles are sorted
    std::vector<std::string> uses;  ///< in the order of a frame's stages
    std::vector<LeftOut> left_out;
    std::size_t bytes = 0;  ///< memory of the packed scene
};

/// The features that a scene uses, in words.
[[nodiscard]] inline std::vector<std::string> used_features(const LoweredScene& lowered,
                                                            Traversal traversal)
{
    std::vector<std::string> uses;
    const auto add = [&](bool used, const char* what) {
        if (used)
            uses.emplace_back(what);
    };
    add(traversal == Traversal::tree, "hierarchy");
    add(!lowered.spheres.empty(), "spheres");
    add(!lowered.anchored_spheres.empty(), "anchored spheres");
    add(!lowered.planes.empty(), "planes");
    add(!lowered.quadrics.empty(), "quadrics");
    add(!lowered.polygons.empty(), "polygons");
    add(std::any_of(lowered.quadrics.begin(), lowered.quadrics.end(),
                    [](const LoweredQuadric& quadric) { return quadric.clipped(); }),
        "clipping");
    add(!lowered.checkers.empty(), "checkers");
    add(!lowered.lights.empty(), lowered.lights.size() > 1 ? "several lights" : "one light");
    add(lowered.highlights, "highlights");
    add(lowered.shadows && !lowered.transparent_shadows, "opaque shadows");
    add(lowered.transparent_shadows, "transparent shadows");
    add(lowered.bounces, "mirrored rays");
    add(lowered.features.glass, "refracted rays");
    return uses;
}

[[nodiscard]] inline SceneFeatures scene_features(const Scene& scene, const IsaInfo& isa)
{
    LoweredScene lowered = lower(scene);
    SceneFeatures features;
    features.left_out = prune(lowered);
    const Traversal traversal = frame_traversal(lowered, Traversal::automatic, isa.lanes_single);
    for (LeftOut& unused : unused_features(lowered, traversal))
        features.left_out.push_back(std::move(unused));
    features.uses = used_features(lowered, traversal);
    features.kernel =
        kernels_for(precision<float>(kernels_of(isa.name)), lowered.features).set.name;
    const PackedScene<float> packed(lowered, traversal);
    features.in_registers = fused_for(precision<float>(kernels_of(isa.name)), lowered.features,
                                      packed.view()) != nullptr;
    features.sorts_mirrored = sorts_mirrored(lowered.features, packed.view());
    features.bytes = packed.bytes();
    const double camera_rays = static_cast<double>(scene.width) * scene.height;
    if (camera_rays >= camera_rays_for_buffers(packed, lowered.bounces)) {
        features.uses.emplace_back("light buffers");
        features.bytes += BufferedScene<float>(packed).bytes();
    }
    return features;
}

}  // namespace packtrace::cli
