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
/// Tiles that are rendered together: a square of at most `block_edge` by `block_edge` tiles.
inline constexpr int block_edge = 8;
inline constexpr int block_tiles = block_edge * block_edge;

/// Positions in a tile that camera rays pass through, instead of one ray per pixel. They are
/// counted from the tile's first pixel to the right and down, each in [0, tile_size]. The camera's
/// own sample position is ignored, so `first_x` and `first_y` should be those of the upper left
/// corner of a pixel.
template <class Real>
struct TileSamples {
    alignas(64) Real column[tile_pixels] = {};
    alignas(64) Real row[tile_pixels] = {};
    int count = 0;  ///< 1 … tile_pixels
};

/// One tile of one frame. The kernel fills rows y … y + height - 1 and columns x … x + width - 1 of
/// a picture whose pixels are interleaved r, g, b.
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
    /// Null: one ray per pixel. Otherwise the colour of sample i goes to rgb[3 i], and `width`,
    /// `height` and `row_stride` are ignored. closest_tile accepts no samples.
    const TileSamples<Real>* samples = nullptr;
    /// The plan that FusedKernels::make_plan made for the scene and camera; other kernels ignore
    /// it.
    const void* plan = nullptr;
    /// Receives the events of kernels with Features::probe, if set; other kernels ignore it.
    const Probe<Real>* probe = nullptr;
    Observation* observation = nullptr;
};

/// Closest hits of the camera rays of a tile, without shading. Rays are numbered along the tile's
/// Z-order curve: bits 0, 2, 4 and 6 of the number are the column, the other bits the row.
template <class Real>
struct TileHits {
    Real t[tile_pixels];
    lane_int<Real> surface[tile_pixels];  ///< -1 for a miss
};

/// The unit of the light that a pixel may lack because rays were not traced. The light is counted
/// in whole units.
inline constexpr double lack_unit = 0x1p-40;

/// How many rays of each kind were traced, and what was computed for them.
struct RayCounts {
    std::uint64_t camera = 0;
    std::uint64_t shadow = 0;
    std::uint64_t reflected = 0;
    std::uint64_t refracted = 0;
    std::uint64_t unsure = 0;  ///< traced again in double
    std::uint64_t cut = 0;     ///< not traced, as their weight is below RayRules::min_weight
    /// Upper bound of the light that any one pixel lacks for the rays not traced.
    double lacks = 0.0;
    std::uint32_t passed = 0;  ///< bits of Passed

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

/// The kernels of one precision for one feature set. All are null if they are not compiled.
template <class Real>
struct FeatureKernels {
    FeatureSet set;
    /// Enough for render_tiles() of `tiles` tiles or fewer.
    std::size_t (*scratch_bytes)(const SceneView<Real>& scene, int tiles) = nullptr;
    /// Renders 1 … block_tiles tiles of one frame, which share scratch memory. Pixels have the same
    /// bits as when each tile is rendered alone. Several tiles are accepted only for scenes without
    /// glass: their reflected rays are sorted and traced together. Only the first tile's
    /// observation is used; it distinguishes pixels only if there is one tile.
    RayCounts (*render_tiles)(const TileJob<Real>* tiles, int count) = nullptr;
    /// Traces the tile's camera rays only; `rgb` is not used. Null for kernels of Features::probe.
    void (*closest_tile)(const TileJob<Real>& job, TileHits<Real>& hits) = nullptr;
};

/// The kernels that trace whole paths in registers, from the camera to the last mirror, for scenes
/// of few objects. All are null if they are not compiled.
template <class Real>
struct FusedKernels {
    Features features;
    /// The size of the data that the tiles of a frame share; 0 if the scene cannot be rendered this
    /// way.
    std::size_t (*plan_bytes)(const SceneView<Real>& scene) = nullptr;
    /// `memory` is 64-byte aligned and has `plan_bytes`. Only the origin of the camera is read.
    void (*make_plan)(const SceneView<Real>& scene, const CameraView<Real>& camera,
                      void* memory) = nullptr;
    std::size_t (*scratch_bytes)(const SceneView<Real>& scene) = nullptr;
    /// Like FeatureKernels::render_tiles, with the same bits. TileJob::plan is set.
    RayCounts (*render_tiles)(const TileJob<Real>* tiles, int count) = nullptr;
};

/// In exact mode, the first set is for spheres and planes whose mirrors are not tinted, the second
/// for everything but glass. The third is for everything but glass in fast mode.
inline constexpr int fused_set_count = 3;
struct FusedTable {
    FusedKernels<float> set[fused_set_count] = {};
};

/// The kernels of one precision.
template <class Real>
struct PrecisionTable {
    int lanes = 0;
    /// First the kernels of Features::exact, for floats only; then those without, for each set.
    FeatureKernels<Real> kernels[2 * feature_set_count];
    FusedKernels<Real> fused[fused_set_count];
    // Rays from the caller, against surfaces of every kind. `scratch` is working memory of
    // `stream_scratch_bytes` (for `lit`: `lit_scratch_bytes`), 64-byte aligned, used by one call at
    // a time.
    std::size_t (*stream_scratch_bytes)(const SceneView<Real>& scene) = nullptr;
    std::size_t (*lit_scratch_bytes)(const SceneView<Real>& scene) = nullptr;
    void (*closest_hits)(const SceneView<Real>& scene, const RaysView<Real>& rays,
                         const HitsView<Real>& hits, void* scratch) = nullptr;
    /// mask[i] is 1 if ray i hits anything, else 0.
    void (*occluded)(const SceneView<Real>& scene, const RaysView<Real>& rays, std::uint8_t* mask,
                     void* scratch) = nullptr;
    /// mask[i] is 1 if no object that casts shadows is between point i and the light, else 0.
    /// `buffer` is the light buffer of the objects that cast shadows, or null.
    void (*lit)(const SceneView<Real>& scene, const PointsView<Real>& points,
                const LightRecord<Real>& light, const LightBuffer* buffer, std::uint8_t* mask,
                void* scratch) = nullptr;
    void (*all_hits)(const SceneView<Real>& scene, const RaysView<Real>& rays,
                     const HitSink<Real>& sink) = nullptr;
    /// y[i] = x[i]^n[i], as computed for highlights: x in [0, 1 + 1e-6], n > 0.
    void (*highlight_power)(const Real* x, const Real* n, Real* y, int count) = nullptr;
    /// Runs one operation of simd.hpp over whole packets; see self_test.hpp.
    void (*self_test)(const SelfTestJob<Real>& job) = nullptr;
};

/// The kernels of Features::probe, which only src/lab uses.
struct ProbeKernels {
    FeatureKernels<float> exact;
    FeatureKernels<float> single_precision;
    FeatureKernels<double> double_precision;
};

/// The kernels of one instruction set.
struct KernelTable {
    const char* isa = nullptr;
    PrecisionTable<float> single_precision;
    PrecisionTable<double> double_precision;
    OnedimTable onedim;
};

}  // namespace packtrace::abi
