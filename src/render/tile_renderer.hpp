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

/// Where tiles go: an image that holds a part of a picture.
template <class Real>
struct Canvas {
    Image<Real>& image;
    int first_column = 0;
    int first_row = 0;

    Canvas(Image<Real>& part, int column = 0, int row = 0)
        : image(part), first_column(column), first_row(row)
    {
    }
    /// By column and row of the picture.
    [[nodiscard]] Real* pixel(int x, int y) const
    {
        return image.pixel(x - first_column, y - first_row);
    }
};

/// A scene and the kernels for it, a piece of a picture after the other. A piece begins where a
/// tile does, and is at most block_edge() long and wide. Thread-safe.
template <class Real>
class TileRenderer {
public:
    /// Of the options traversal, sampling and force_general count. What the picture does not need
    /// of `lowered` is left out.
    TileRenderer(const Scene& scene, LoweredScene lowered, const abi::KernelTable& table,
                 const RenderOptions& options);
    TileRenderer(const TileRenderer&) = delete;
    TileRenderer& operator=(const TileRenderer&) = delete;

    /// The edge of pieces, in pixels, that threads render a region of the picture by: a tile's, or
    /// one of several tiles whose mirrored rays are better traced together.
    [[nodiscard]] int block_edge(const Region& region, int threads) const;

    /// Fills a piece with one sample a pixel: the scene's own, or of several the centre. Here and
    /// below kernels of Features::probe record into `observation`, unless it is null.
    abi::RayCounts render_once(const Canvas<Real>& canvas, const Region& piece,
                               abi::Observation* observation = nullptr) const;

    /// Fills it with as many samples as the options say, none of them adaptive.
    abi::RayCounts render(const Canvas<Real>& canvas, const Region& piece,
                          abi::Observation* observation = nullptr) const;

    /// `contrast` is that of the canvas. Gives the pixels of a tile where `contrast` says so what
    /// render() gives them, bit for bit.
    abi::RayCounts refine(const Canvas<Real>& canvas, const ContrastMap<Real>& contrast,
                          const Region& tile, abi::Observation* observation = nullptr) const;

    /// Counts camera rays that are about to be rendered. Once there are so many of them that
    /// lights' own views of the scene pay, these are made, and used from then on.
    void expect(double camera_rays) const;

    /// Working memory of a thread.
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

    /// A scene without what the picture does not need.
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
    abi::CameraView<Real> once_;            // one sample a pixel
    abi::CameraView<Real> corner_;          // through the upper left corner of each pixel
    const abi::FusedKernels<Real>* fused_;  // null where streams render the scene
    AlignedArray<std::byte> plan_;          // of those
    abi::RayCounts (*render_tiles_)(const abi::TileJob<Real>* tiles, int count);
    bool sorts_mirrored_;
    std::size_t scratch_bytes_;
    mutable tbb::enumerable_thread_specific<AlignedArray<std::byte>> scratch_;
};

}  // namespace packtrace
