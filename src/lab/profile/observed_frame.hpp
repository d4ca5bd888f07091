#pragma once

#include <chrono>

#include <packtrace/render.hpp>

#include "image/contrast.hpp"
#include "kernel_abi/observation.hpp"
#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"

namespace packtrace {

/// The same scene for kernels that observe their stages.
[[nodiscard]] LoweredScene observable(LoweredScene lowered);

/// Frames on one thread, tile by tile, any of whose tiles may be observed.
template <class Real>
class ObservedFrame {
public:
    /// Kernels are those that `lowered` asks for; only those of an observable() scene observe.
    ObservedFrame(const Scene& scene, const LoweredScene& lowered, const abi::KernelTable& table,
                  const RenderOptions& options)
        : width_(scene.width),
          height_(scene.height),
          options_(options),
          tiles_(scene, lowered, table, options),
          image_(scene.width, scene.height)
    {
    }

    /// A tile, or with adaptive sampling each of its two turns, is a piece.
    [[nodiscard]] int pieces() const
    {
        return TileGrid(width_, height_).count * (options_.adaptive ? 2 : 1);
    }

    /// `before(piece)` returns what to record into, or null; `after(piece, seconds)` is told what
    /// it took.
    template <class Before, class After>
    FrameCounts render(const Before& before, const After& after)
    {
        abi::RayCounts sum;
        int piece = 0;
        const auto turn = [&](const auto& render_tile) {
            const TileGrid grid(width_, height_);
            for (int tile = 0; tile < grid.count; ++tile, ++piece) {
                tiles_.observe(before(piece));
                const auto start = std::chrono::steady_clock::now();
                sum += render_tile(tile % grid.columns * abi::tile_size,
                                   tile / grid.columns * abi::tile_size);
                const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
                after(piece, time.count());
            }
        };
        if (options_.adaptive) {
            turn([&](int x, int y) { return tiles_.render_once(image_, x, y); });
            ContrastMap<Real> contrast(image_, *options_.adaptive);
            for (int y = 0; y < height_; ++y)
                contrast.mark_row(y);
            turn([&](int x, int y) { return tiles_.refine(image_, contrast, x, y); });
        } else {
            turn([&](int x, int y) {
                return options_.samples > 1 ? tiles_.render_mean(image_, x, y)
                                            : tiles_.render_once(image_, x, y);
            });
        }
        return {sum.camera, sum.shadow, sum.reflected, sum.refracted, sum.unsure};
    }

    [[nodiscard]] const Image<Real>& image() const
    {
        return image_;
    }

private:
    int width_;
    int height_;
    RenderOptions options_;
    TileRenderer<Real> tiles_;
    Image<Real> image_;
};

}  // namespace packtrace
