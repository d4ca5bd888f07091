#pragma once

#include "core/seconds_since.hpp"
#include "image/contrast.hpp"
#include "kernel_abi/observation.hpp"
#include "lab/harness/statistics.hpp"
#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"
#include <packtrace/render.hpp>

#include <chrono>
#include <vector>

// Frames that are traced piece by piece, with kernels that observe themselves or without, and the
// times of the pieces.
namespace packtrace {

/// The scene with features for which the observing kernels are chosen.
[[nodiscard]] LoweredScene observable(LoweredScene lowered);

/// Renders frames on one thread, piece by piece.
template <class Real>
class ObservedFrame {
public:
    /// Only kernels of an observable() scene observe.
    ObservedFrame(const Scene& scene, const LoweredScene& lowered, const abi::KernelTable& table,
                  const RenderOptions& options)
        : options_(options),
          tiles_(scene, lowered, table, options),
          image_(scene.width, scene.height),
          picture_{0, 0, scene.width, scene.height},
          blocks_(picture_, tiles_.block_edge(picture_, 1))
    {
    }

    /// The number of pieces: blocks of tiles, and with adaptive sampling also tiles to refine.
    [[nodiscard]] int pieces() const
    {
        return blocks_.count() + (options_.adaptive ? TileGrid(picture_).count() : 0);
    }

    /// `before(piece)` returns what to record into, or null; `after(piece, seconds)` receives the
    /// time of the piece.
    template <class Before, class After>
    FrameCounts render(const Before& before, const After& after)
    {
        abi::RayCounts sum;
        int piece = 0;
        const auto turn = [&](const TileGrid& grid, const auto& render_piece) {
            for (int i = 0; i < grid.count(); ++i, ++piece) {
                abi::Observation* const observation = before(piece);
                const auto start = std::chrono::steady_clock::now();
                sum += render_piece(grid[i], observation);
                after(piece, seconds_since(start));
            }
        };
        if (options_.adaptive) {
            turn(blocks_, [&](const Region& block, abi::Observation* observation) {
                return tiles_.render_once(image_, block, observation);
            });
            ContrastMap<Real> contrast(image_, *options_.adaptive);
            for (int y = 0; y < image_.height; ++y)
                contrast.mark_row(y);
            turn(TileGrid(picture_), [&](const Region& tile, abi::Observation* observation) {
                return tiles_.refine(image_, contrast, tile, observation);
            });
        } else {
            turn(blocks_, [&](const Region& block, abi::Observation* observation) {
                return tiles_.render(image_, block, observation);
            });
        }
        return {sum.camera, sum.shadow, sum.reflected, sum.refracted, sum.unsure};
    }

    [[nodiscard]] const Image<Real>& image() const
    {
        return image_;
    }

private:
    RenderOptions options_;
    TileRenderer<Real> tiles_;
    Image<Real> image_;
    Region picture_;
    TileGrid blocks_;
};

/// Times of a frame's pieces. The time of the frame is the sum of their medians, so that a busy
/// moment of the machine does not count.
class PieceTimes {
public:
    explicit PieceTimes(int pieces) : seconds_(static_cast<std::size_t>(pieces))
    {
    }

    void add(int piece, double seconds)
    {
        seconds_[static_cast<std::size_t>(piece)].push_back(seconds);
    }

    /// Each piece must have been added at least once.
    [[nodiscard]] double frame() const
    {
        double sum = 0.0;
        for (const std::vector<double>& piece : seconds_)
            sum += median_of(piece);
        return sum;
    }

private:
    std::vector<std::vector<double>> seconds_;
};

}  // namespace packtrace
