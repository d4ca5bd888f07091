#pragma once

#include "core/progress.hpp"
#include "kernel_abi/kernel_table.hpp"
#include <packtrace/renderer.hpp>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

namespace packtrace {

/// Calls `visit(number, x, y)` for the pixels of a tile. Kernels number the pixels of a full tile
/// along a Z-order curve.
template <class Visit>
void for_each_pixel(const Region& tile, const Visit& visit)
{
    for (int number = 0; number < abi::tile_pixels; ++number) {
        int place[2] = {tile.x, tile.y};
        for (int bit = 0; (1 << bit) < abi::tile_pixels; ++bit)
            place[bit % 2] += ((number >> bit) & 1) << (bit / 2);
        if (tile.contains(place[0], place[1]))
            visit(number, place[0], place[1]);
    }
}

/// Divides a picture into squares, row by row. Their edge is that of one tile or of several.
/// Instead of a picture it may be a region that begins at a tile's corner.
class TileGrid {
public:
    explicit TileGrid(const Region& region, int edge = abi::tile_size)
        : region_(region), edge_(edge), columns_(pieces_along(region.width))
    {
    }

    [[nodiscard]] int count() const
    {
        return columns_ * pieces_along(region_.height);
    }

    /// Pieces at the region's right and lower edges may be smaller.
    [[nodiscard]] Region operator[](int piece) const
    {
        const int x = piece % columns_ * edge_;
        const int y = piece / columns_ * edge_;
        return {region_.x + x, region_.y + y, std::min(edge_, region_.width - x),
                std::min(edge_, region_.height - y)};
    }

private:
    [[nodiscard]] int pieces_along(int pixels) const
    {
        return (pixels + edge_ - 1) / edge_;
    }

    Region region_;
    int edge_;
    int columns_;
};

/// Distributes runs of pieces to threads. Runs get shorter towards the end, so that all threads end
/// at about one time (Polychronopoulos and Kuck, "Guided Self-Scheduling", 1987). One task per tile
/// costs 3 % of the shortest frames. Short runs from the start cost 3 % with two threads, because
/// both then write to the same pages.
class TileQueue {
public:
    TileQueue(int count, int threads) : count_(count), shares_(8 * threads)
    {
    }

    struct Run {
        int begin;
        int end;
    };
    /// Empty if no pieces are left.
    Run take()
    {
        int begin = next_.load(std::memory_order_relaxed);
        int end = begin;
        do {
            end = begin + std::max((count_ - begin) / shares_, std::min(1, count_ - begin));
        } while (!next_.compare_exchange_weak(begin, end, std::memory_order_relaxed));
        return {begin, end};
    }

private:
    int count_;
    int shares_;
    std::atomic<int> next_{0};
};

/// Calls `work(piece)`, which returns abi::RayCounts, for each piece of the grid, on the threads of
/// the TBB arena of the caller. Returns the sum of all counts. Throws StopError as `done` does.
template <class Work>
[[nodiscard]] FrameCounts for_each_piece(const TileGrid& grid, Progress& done, const Work& work)
{
    const int threads = tbb::this_task_arena::max_concurrency();
    TileQueue queue(grid.count(), threads);
    tbb::enumerable_thread_specific<abi::RayCounts> counts;
    tbb::parallel_for(
        0, threads,
        [&](int) {
            abi::RayCounts& sum = counts.local();
            for (auto run = queue.take(); run.begin != run.end; run = queue.take()) {
                for (int piece = run.begin; piece != run.end && !done.is_stopped(); ++piece) {
                    sum += work(grid[piece]);
                    done.finish_piece();
                }
            }
        },
        tbb::simple_partitioner());
    done.check_stop();
    const abi::RayCounts sum =
        counts.combine([](abi::RayCounts a, const abi::RayCounts& b) { return a += b; });
    return {sum.camera, sum.shadow, sum.reflected, sum.refracted, sum.unsure, {sum.cut, sum.lacks}};
}

}  // namespace packtrace
