#include "core/arena.hpp"
#include "core/seconds_since.hpp"
#include "core/text.hpp"
#include "dispatch/kernels.hpp"
#include "image/color_ramp.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/profile/profile_steps.hpp"
#include "render/camera_view.hpp"
#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"
#include <packtrace/profile.hpp>
#include <packtrace/validate.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <stdexcept>
#include <string>

namespace packtrace {
namespace {

using Clock = std::chrono::steady_clock;

// Copies of a pixel that are traced together, so that packets are full and the clock is exact
// enough.
constexpr int copies = 64;

// Numbers threads in the order in which they ask.
class ThreadNumbers {
public:
    int mine()
    {
        int& number = numbers_.local();
        if (number < 0)
            number = count_++;
        return number;
    }

private:
    std::atomic<int> count_{0};
    tbb::enumerable_thread_specific<int> numbers_{-1};
};

std::string nanoseconds(double seconds)
{
    return fixed(1e9 * seconds, 1) + "ns";
}

}  // namespace

template <class Real>
std::vector<TileSpan> trace_tiles(const Scene& scene, const ProfileOptions& options)
{
    validate(scene);
    RenderOptions sampling = render_options(options);
    sampling.adaptive.reset();
    const LoweredScene lowered = lower_for<Real>(scene, sampling);
    const TileRenderer<Real> tiles(scene, lowered, kernels_of(choose_isa(options.isa).name),
                                   sampling);
    const Region picture{0, 0, scene.width, scene.height};
    const TileGrid grid(picture, tiles.block_edge(picture, options.threads));
    Image<Real> image(scene.width, scene.height);
    const auto render = [&](const Region& piece) { return tiles.render(image, piece); };
    std::vector<TileSpan> spans;
    run_on_threads(options.threads, [&] {
        const std::function<void(double)> silent;
        // The first frame allocates memory.
        Progress first(grid.count(), silent);
        (void)for_each_piece(grid, first, render);
        Progress done(grid.count(), silent);
        ThreadNumbers threads;
        std::mutex mutex;
        const auto start = Clock::now();
        (void)for_each_piece(grid, done, [&](const Region& piece) {
            const auto from = Clock::now();
            const abi::RayCounts rays = render(piece);
            const auto to = Clock::now();
            const std::lock_guard lock(mutex);
            spans.push_back({piece.x, piece.y, threads.mine(), seconds_between(start, from),
                             seconds_between(from, to),
                             rays.camera + rays.shadow + rays.reflected + rays.refracted});
            return rays;
        });
    });
    std::sort(spans.begin(), spans.end(),
              [](const TileSpan& a, const TileSpan& b) { return a.start < b.start; });
    return spans;
}

template <class Real>
std::vector<double> pixel_costs(const Scene& scene, const ProfileOptions& options)
{
    validate(scene);
    const LoweredScene lowered = lower_for<Real>(scene, render_options(options));
    const auto& table = precision<Real>(kernels_of(choose_isa(options.isa).name));
    const PackedScene<Real> packed(lowered,
                                   frame_traversal(lowered, Traversal::automatic, table.lanes));
    const auto camera = camera_view<Real>(scene, lowered, Vec2(0.0));
    const auto& kernels = kernels_for(table, lowered.features);
    AlignedArray<std::byte> scratch(kernels.scratch_bytes(packed.view(), 1));
    abi::TileSamples<Real> samples{.count = copies};
    Real rgb[3 * abi::tile_pixels];
    abi::TileJob<Real> job{.scene = &packed.view(),
                           .camera = &camera,
                           .rgb = rgb,
                           .scratch = scratch.data(),
                           .samples = &samples};
    const Vec2 place = scene.camera.pixel_sample;
    std::vector<double> costs;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            job.x = x - x % abi::tile_size;
            job.y = y - y % abi::tile_size;
            std::fill_n(samples.column, copies, static_cast<Real>(x - job.x + place.x));
            std::fill_n(samples.row, copies, static_cast<Real>(y - job.y + place.y));
            double least = 0.0;
            // The faster of two turns counts: the other may have been interrupted.
            for (int turn = 0; turn < 2; ++turn) {
                const auto from = Clock::now();
                (void)kernels.render_tiles(&job, 1);
                const double seconds = seconds_between(from, Clock::now()) / copies;
                least = turn == 0 ? seconds : std::min(least, seconds);
            }
            costs.push_back(least);
        }
    return costs;
}

Image<float> cost_picture(const std::vector<double>& seconds, int width, int height)
{
    Image<float> image(width, height);
    if (seconds.empty() || 3 * seconds.size() != image.rgb.size())
        throw std::invalid_argument("cost_picture: " + std::to_string(seconds.size()) +
                                    " times for a picture of " + std::to_string(width) + " x " +
                                    std::to_string(height) + " pixels; give each pixel one");
    // The scale leaves out a thousandth at both ends, so that interrupted pixels do not stretch it.
    const double low = quantile(seconds, 0.001);
    const double high = std::max(quantile(seconds, 0.999), low * 1.0001);
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        const auto color = color_ramp(std::clamp((seconds[i] - low) / (high - low), 0.0, 1.0));
        std::copy(color.begin(), color.end(), &image.rgb[3 * i]);
    }
    return with_legend(image, nanoseconds(low), nanoseconds(high));
}

template std::vector<TileSpan> trace_tiles<float>(const Scene&, const ProfileOptions&);
template std::vector<TileSpan> trace_tiles<double>(const Scene&, const ProfileOptions&);
template std::vector<double> pixel_costs<float>(const Scene&, const ProfileOptions&);
template std::vector<double> pixel_costs<double>(const Scene&, const ProfileOptions&);

}  // namespace packtrace
