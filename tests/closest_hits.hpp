#pragma once

#include "core/aligned_array.hpp"
#include "dispatch/kernels.hpp"
#include "exact_hits.hpp"
#include "lower/packed_scene.hpp"
#include "render/camera_view.hpp"

#include <cstdint>
#include <vector>

// Runs the closest-hit kernel over a scene's camera rays.
namespace packtrace::test {

/// A camera ray, with the bits that the kernels trace, and its hit; object -1 for a miss.
template <class Real>
struct TracedRay {
    LongRay ray;
    Real t = 0;
    int object = -1;
};

/// The direction to a canvas point, rounded as the kernels round it.
template <class Real>
[[nodiscard]] LongVec rounded_direction(const abi::CameraView<Real>& camera, Real x, Real y,
                                        bool fused)
{
    LongVec dir;
    for (int axis = 0; axis < 3; ++axis) {
        const Real right = camera.right[axis];
        const Real up = camera.up[axis];
        const Real forward = camera.forward[axis];
        const Real upwards = fused ? std::fma(y, up, forward) : y * up + forward;
        dir[axis] = fused ? std::fma(x, right, upwards) : x * right + upwards;
    }
    return dir;
}

/// Bits 0, 2, 4 and 6 of `number`: one coordinate of an index along a tile's Z-order curve.
[[nodiscard]] inline int even_bits(int number)
{
    int result = 0;
    for (int bit = 0; bit < 4; ++bit)
        result |= ((number >> (2 * bit)) & 1) << bit;
    return result;
}

/// All arguments of the kernel for one scene.
template <class Real>
struct TracingSetup {
    LoweredScene lowered;
    PackedScene<Real> packed;
    abi::CameraView<Real> camera;

    /// The mode applies to floats; doubles have only one.
    explicit TracingSetup(const Scene& scene, Accuracy accuracy = Accuracy::exact)
        : lowered(lower(scene, sizeof(Real) == sizeof(float) ? accuracy : Accuracy::fast)),
          packed(lowered),
          camera(camera_view<Real>(scene, lowered))
    {
    }
};

template <class Real>
void append_tile(std::vector<TracedRay<Real>>& rays, const abi::CameraView<Real>& camera,
                 const abi::TileJob<Real>& job, const abi::TileHits<Real>& hits, bool fused)
{
    for (int number = 0; number < abi::tile_pixels; ++number) {
        const Real x = static_cast<Real>(job.x + even_bits(number)) + camera.first_x;
        const Real y = camera.first_y - static_cast<Real>(job.y + even_bits(number >> 1));
        TracedRay<Real> traced;
        traced.ray.org = {camera.origin[0], camera.origin[1], camera.origin[2]};
        traced.ray.dir = rounded_direction(camera, x, y, fused);
        traced.ray.t_min = camera.t_min;
        traced.t = hits.t[number];
        traced.object = static_cast<int>(hits.surface[number]);
        rays.push_back(traced);
    }
}

/// Traces whole tiles over the picture. Tiles at the right and lower edge extend beyond the
/// picture.
template <class Real>
[[nodiscard]] std::vector<TracedRay<Real>> trace_closest(const abi::KernelTable& table,
                                                         const TracingSetup<Real>& setup,
                                                         const Scene& scene)
{
    const abi::FeatureKernels<Real>& kernels =
        kernels_for(precision<Real>(table), setup.lowered.features);
    const bool fused = std::string(table.isa) != "sse42";
    const AlignedArray<std::byte> scratch(kernels.scratch_bytes(setup.packed.view(), 1));
    std::vector<TracedRay<Real>> rays;
    for (int y = 0; y < scene.height; y += abi::tile_size)
        for (int x = 0; x < scene.width; x += abi::tile_size) {
            abi::TileJob<Real> job{.scene = &setup.packed.view(),
                                   .camera = &setup.camera,
                                   .x = x,
                                   .y = y,
                                   .scratch = scratch.data()};
            abi::TileHits<Real> hits;
            kernels.closest_tile(job, hits);
            append_tile(rays, setup.camera, job, hits, fused);
        }
    return rays;
}

}  // namespace packtrace::test
