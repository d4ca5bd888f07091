#pragma once

#include <packtrace/renderer.hpp>

#include <algorithm>
#include <atomic>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "kernel_abi/kernel_table.hpp"
#include "render/progress.hpp"

namespace packtrace {

/// How a picture is cut, or a region of it that begins where a tile does.
struct TileGrid {
    int columns;
    int count;
    int first_column = 0;
    int first_row = 0;

    TileGrid(int width, int height)
        : columns((width + abi::tile_size - 1) / abi::tile_size),
          count(columns * ((height + abi::tile_size - 1) / abi::tile_size))
    {
    }
    explicit TileGrid(const Region& tiles) : TileGrid(tiles.width, tiles.height)
    {
        first_column = tiles.x;
        first_row = tiles.y;
    }
};

/// Hands out runs of tiles to threads, shorter ones towards the end, so that all end together
/// (Polychronopoulos and Kuck, "Guided Self-Scheduling", 1987). A task a tile costs 3 % of the
/// frames that take the least, and short runs from the start 3 % of those of two threads, which
/// then write to the same pages.
class TileQueue {
public:
    TileQueue(int count, int threads) : count_(count), shares_(8 * threads)
    {
    }

    struct Run {
        int begin;
        int end;
    };
    /// Empty when there are no more.
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

/// Calls `work(x, y)`, which returns abi::RayCounts, for each tile's first pixel, from the
/// threads of the arena the call runs in. The sum is that of all tiles. Throws StopError as `done`
/// does.
template <class Work>
[[nodiscard]] FrameCounts for_each_tile(const TileGrid& grid, Progress& done, const Work& work)
{
    const int threads = tbb::this_task_arena::max_concurrency();
    TileQueue queue(grid.count, threads);
    tbb::enumerable_thread_specific<abi::RayCounts> counts;
    tbb::parallel_for(
        0, threads,
        [&](int) {
            abi::RayCounts& sum = counts.local();
            for (auto run = queue.take(); run.begin != run.end; run = queue.take()) {
                for (int tile = run.begin; tile != run.end && !done.is_stopped(); ++tile) {
                    sum += work(grid.first_column + tile % grid.columns * abi::tile_size,
                                grid.first_row + tile / grid.columns * abi::tile_size);
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
