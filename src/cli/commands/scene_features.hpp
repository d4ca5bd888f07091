#pragma once

#include <string>
#include <vector>

#include <packtrace/isa.hpp>
#include <packtrace/scene.hpp>

#include "lower/leave_out.hpp"

namespace packtrace::cli {

/// What becomes of a scene when packets of floats render it.
struct SceneFeatures {
    std::string kernel;             ///< name of the feature set
    bool in_registers = false;      ///< paths are traced in registers, without streams
    bool sorts_mirrored = false;    ///< mirrored rays of several tiles are sorted
    std::vector<std::string> uses;  ///< in the order of a frame's stages
    std::vector<LeftOut> left_out;
    std::size_t bytes = 0;  ///< held for the scene by packets
};

[[nodiscard]] SceneFeatures scene_features(const Scene& scene, const IsaInfo& isa);

}  // namespace packtrace::cli
