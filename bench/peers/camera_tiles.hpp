#pragma once

#include "core/aligned_array.hpp"
#include "dispatch/kernels.hpp"
#include "lower/packed_scene.hpp"
#include "ray_set.hpp"
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <string>

namespace packtrace::peers {

/// Closest hits of camera rays, tile by tile, as in the renderer.
class CameraTiles {
public:
    CameraTiles(const Scene& scene, const std::string& isa, Accuracy accuracy);
    /// Seconds; the hits are in the order of camera_rays().
    double trace(Hits& hits);

private:
    LoweredScene lowered_;
    PackedScene<float> packed_;
    abi::CameraView<float> camera_;
    const abi::FeatureKernels<float>& kernels_;
    AlignedArray<std::byte> scratch_;
    abi::TileJob<float> job_;
    int width_;
    int height_;
};

}  // namespace packtrace::peers
