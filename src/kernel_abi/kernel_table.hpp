#pragma once

#include "kernel_abi/features.hpp"
#include "kernel_abi/observation.hpp"
#include "kernel_abi/onedim_table.hpp"
#include "kernel_abi/passed.hpp"
#include "kernel_abi/probe.hpp"
#include "kernel_abi/ray_streams.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernel_abi/self_test.hpp"

#include <cstddef>
#include <cstdint>

namespace packtrace::abi {

/// Edge of a tile, pixels.
inline constexpr int tile_size = 16;
inline constexpr int tile_pixels = tile_size * tile_size;
/// Tiles that are rendered together: at most a square of `block_edge` tiles.
inline constexpr int block_edge = 8;
inline constexpr int block_tiles = block_edge * block_edge;

/// Places in a tile that camera rays go through, in place of one a pixel. Counted from its first
/// pixel to the right and down, each in [0, tile_size]; the camera's own sample is not looked at
/// otherwise, so that `first_x` and `first_y` should be those of a pixel's upper left corner.
template <class Real>
struct TileSamples {
    alignas(64) Real column[tile_pixels] = {};
    alignas(64) Real row[tile_pixels] = {};
    int count = 0;  ///< 1 … tile_pixels
};

/// One tile of one frame. The kernel fills rows y … y + height - 1, columns x … x + width - 1
/// of a picture whose pixels are interleaved r, g, b.
template <class Real>
struct TileJob {
    const SceneView<Real>* scene = nullptr;
    const CameraView<Real>* camera = nullptr;
    int x = 0;
    int y = 0;
    int width = tile_size;          ///< 1 … tile_size
    int height = tile_size;         ///< 1 … tile_size
    Real* rgb = nullptr;            ///< the tile's first pixel
    std::ptrdiff_t row_stride = 0;  ///< elements from one row to the next
    /// Working memory of `scratch_bytes`, 64-byte aligned, one per thread.
    void* scratch = nullptr;
    /// Null: one ray a pixel. Else the colour of sample i goes to rgb[3 i], and `width`, `height`
    /// and `row_stride` are not looked at. closest_tile takes none.
    const TileSamples<Real>* samples = nullptr;
    /// What FusedKernels::make_plan made for the scene and the camera; others don't look at it.
    const void* plan = nullptr;
    /// What kernels of Features::probe tell of, where set; not looked at by others.
    const Probe<Real>* probe = nullptr;
    Observation* observation = nullptr;
};

/// Closest hits of a tile's camera rays, without shading. Rays are numbered along the tile's
/// Z-order curve: bits 0, 2, 4, 6 of the number are the column, the others the row.
template <class Real>
struct TileHits {
    Real t[tile_pixels];
    lane_int<Real> surface[tile_pixels];  ///< -1 for a miss
};

/// What pixels lack for rays that are not traced counts in whole ones of these.
inline constexpr double lack_unit = 0x1p-40;

/// How many rays of each kind were traced, and what was done for them.
struct RayCounts {
    std::uint64_t camera = 0;
    std::uint64_t shadow = 0;
    std::uint64_t reflected = 0;
    std::uint64_t refracted = 0;
    std::uint64_t unsure = 0;  ///< traced again in double
    std::uint64_t cut = 0;     ///< not traced, as their weight is below SceneView::min_weight
    double lacks = 0.0;        ///< the most that any one pixel may lack for those
    std::uint32_t passed = 0;  ///< of Passed

    RayCounts& operator+=(const RayCounts& more)
    {
        camera += more.camera;
        shadow += more.shadow;
        reflected += more.reflected;
        refracted += more.refracted;
        unsure += more.unsure;
        cut += more.cut;
        lacks = more.lacks > lacks ? more.lacks : lacks;
        passed |= more.passed;
        return *this;
    }
};

/// The kernels of one precision for one feature set; all null where they are not compiled in.
template <class Real>
struct FeatureKernels {
    FeatureSet set;
    /// For render_tiles() of as many tiles, or fewer.
    std::size_t (*scratch_bytes)(const SceneView<Real>& scene, int tiles) = nullptr;
    /// Renders 1 … block_tiles tiles of a frame, which share their scratch memory. More than one
    /// only of scenes without glass: their mirrored rays are sorted and traced together. Pixels
    /// are those of each tile alone, bit for bit. Of the tiles, the first one's observation counts,
    /// and pixels can be told apart in it only where it is the only one.
    RayCounts (*render_tiles)(const TileJob<Real>* tiles, int count) = nullptr;
    /// The tile's camera rays only; `rgb` is not used. Null for kernels of Features::probe.
    void (*closest_tile)(const TileJob<Real>& job, TileHits<Real>& hits) = nullptr;
};

/// The kernels that trace paths from the eye to the last mirror in registers, for scenes of few
/// objects; all null where they are not compiled in.
template <class Real>
struct FusedKernels {
    Features features;
    /// Of what the tiles of a frame share; 0 where a scene can't be rendered so.
    std::size_t (*plan_bytes)(const SceneView<Real>& scene) = nullptr;
    /// `memory` is 64-byte aligned, and of `plan_bytes`. Of the camera its origin counts.
    void (*make_plan)(const SceneView<Real>& scene, const CameraView<Real>& camera,
                      void* memory) = nullptr;
    std::size_t (*scratch_bytes)(const SceneView<Real>& scene) = nullptr;
    /// As FeatureKernels::render_tiles, bit for bit. TileJob::plan is set.
    RayCounts (*render_tiles)(const TileJob<Real>* tiles, int count) = nullptr;
};

/// Those of spheres and planes with mirrors that are not tinted, and those of all but glass.
inline constexpr int fused_set_count = 2;
struct FusedTable {
    FusedKernels<float> set[fused_set_count] = {};
};

/// The kernels of one precision.
template <class Real>
struct PrecisionTable {
    int lanes = 0;
    /// Those of Features::exact first, for floats alone; then for each set the others.
    FeatureKernels<Real> kernels[2 * feature_set_count];
    FusedKernels<Real> fused[fused_set_count];
    // Rays of the caller's own, against surfaces of every kind.
    // `scratch` is working memory of `stream_scratch_bytes`, 64-byte aligned, for one call at a
    // time; for `lit` of `lit_scratch_bytes`.
    std::size_t (*stream_scratch_bytes)(const SceneView<Real>& scene) = nullptr;
    std::size_t (*lit_scratch_bytes)(const SceneView<Real>& scene) = nullptr;
    void (*closest_hits)(const SceneView<Real>& scene, const RaysView<Real>& rays,
                         const HitsView<Real>& hits, void* scratch) = nullptr;
    /// mask[i] is 1 where ray i hits anything, else 0.
    void (*occluded)(const SceneView<Real>& scene, const RaysView<Real>& rays, std::uint8_t* mask,
                     void* scratch) = nullptr;
    /// mask[i] is 1 where nothing that casts a shadow is between point i and the light, else 0.
    /// `buffer` is the light's view of what casts shadows, or null.
    void (*lit)(const SceneView<Real>& scene, const PointsView<Real>& points,
                const LightRecord<Real>& light, const LightBuffer* buffer, std::uint8_t* mask,
                void* scratch) = nullptr;
    void (*all_hits)(const SceneView<Real>& scene, const RaysView<Real>& rays,
                     const HitSink<Real>& sink) = nullptr;
    /// y[i] = x[i]^n[i] as highlights use it: x in [0, 1 + 1e-6], n > 0.
    void (*highlight_power)(const Real* x, const Real* n, Real* y, int count) = nullptr;
    /// Runs one operation of simd.hpp over whole packets; see self_test.hpp.
    void (*self_test)(const SelfTestJob<Real>& job) = nullptr;
};

/// The kernels of Features::probe, which only src/lab asks for.
struct ProbeKernels {
    FeatureKernels<float> exact;
    FeatureKernels<float> single_precision;
    FeatureKernels<double> double_precision;
};

/// What one instruction set offers.
struct KernelTable {
    const char* isa = nullptr;
    PrecisionTable<float> single_precision;
    PrecisionTable<double> double_precision;
    OnedimTable onedim;
};

}  // namespace packtrace::abi
