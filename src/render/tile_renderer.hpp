#pragma once

#include "core/aligned_array.hpp"
#include "core/made_when_paid.hpp"
#include "image/contrast.hpp"
#include "kernel_abi/kernel_table.hpp"
#include "lower/buffered_scene.hpp"
#include "lower/lowered_scene.hpp"
#include "lower/packed_scene.hpp"
#include <packtrace/render.hpp>

#include <tbb/enumerable_thread_specific.h>

namespace packtrace {

/// The output of tiles: an image that holds a part of a picture.
template <class Real>
struct Canvas {
    Image<Real>& image;
    int first_column = 0;
    int first_row = 0;

    Canvas(Image<Real>& part, int column = 0, int row = 0)
        : image(part), first_column(column), first_row(row)
    {
    }
    /// `x` and `y` are column and row of the picture.
    [[nodiscard]] Real* pixel(int x, int y) const
    {
        return image.pixel(x - first_column, y - first_row);
    }
};

/// Renders a scene piece by piece. A piece begins at a tile's corner, and its sides are at most
/// block_edge(). Thread-safe.
template <class Real>
class TileRenderer {
public:
    /// Uses the options for traversal, sampling and force_general. Prunes `lowered` unless
    /// force_general is set.
    TileRenderer(const Scene& scene, LoweredScene lowered, const abi::KernelTable& table,
                 const RenderOptions& options);
    TileRenderer(const TileRenderer&) = delete;
    TileRenderer& operator=(const TileRenderer&) = delete;

    /// The edge of pieces, in pixels, for a region and a number of threads. It is the edge of a
    /// tile, or of a block of tiles if it is faster to trace their mirrored rays together.
    [[nodiscard]] int block_edge(const Region& region, int threads) const;

    /// Renders a piece with one sample per pixel: the scene's pixel sample, or the centre if the
    /// options want several samples. Here and below, kernels with Features::probe record into
    /// `observation`, unless it is null.
    abi::RayCounts render_once(const Canvas<Real>& canvas, const Region& piece,
                               abi::Observation* observation = nullptr) const;

    /// Renders a piece with all samples of the options in every pixel.
    abi::RayCounts render(const Canvas<Real>& canvas, const Region& piece,
                          abi::Observation* observation = nullptr) const;

    /// Renders the pixels of a tile that are marked in `contrast`, the map of the canvas. They
    /// equal those of render(), bit for bit.
    abi::RayCounts refine(const Canvas<Real>& canvas, const ContrastMap<Real>& contrast,
                          const Region& tile, abi::Observation* observation = nullptr) const;

    /// Counts camera rays that are about to be traced. As soon as there are enough of them for
    /// light buffers to save time, light buffers are built and used.
    void expect(double camera_rays) const;

    /// Working memory of a thread, bytes.
    [[nodiscard]] std::size_t scratch_bytes() const
    {
        return scratch_bytes_;
    }

    [[nodiscard]] std::size_t scene_bytes() const
    {
        const BufferedScene<Real>* const buffered = buffered_.get();
        return packed_.bytes() + (buffered != nullptr ? buffered->bytes() : 0);
    }

private:
    struct Pixels {
        Real* first;
        std::ptrdiff_t row_stride;
    };

    /// A scene after fit(): pruned, or with all features.
    struct Fitted {
        LoweredScene scene;
    };

    TileRenderer(const Scene& scene, const Fitted& fitted, const abi::KernelTable& table,
                 const RenderOptions& options);
    [[nodiscard]] const abi::SceneView<Real>& view() const;
    [[nodiscard]] abi::TileJob<Real> job_of(const abi::CameraView<Real>& camera, const Region& tile,
                                            abi::Observation* observation) const;
    abi::RayCounts render_piece(const abi::CameraView<Real>& camera, const Region& piece,
                                const Pixels& pixels, abi::Observation* observation) const;
    abi::RayCounts render_mean(const Canvas<Real>& canvas, const Region& piece,
                               abi::Observation* observation) const;

    const abi::FeatureKernels<Real>& kernels_;
    PackedScene<Real> packed_;
    double rays_for_buffers_;
    mutable MadeWhenPaid<BufferedScene<Real>> buffered_;
    std::vector<Vec2> pattern_;
    abi::CameraView<Real> once_;            // one sample per pixel
    abi::CameraView<Real> corner_;          // through the upper left corner of each pixel
    const abi::FusedKernels<Real>* fused_;  // null if the stream kernels render the scene
    AlignedArray<std::byte> plan_;          // of the fused kernels
    abi::RayCounts (*render_tiles_)(const abi::TileJob<Real>* tiles, int count);
    bool sorts_mirrored_;
    std::size_t scratch_bytes_;
    mutable tbb::enumerable_thread_specific<AlignedArray<std::byte>> scratch_;
};

}  // namespace packtrace
