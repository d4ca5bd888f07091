#pragma once

#include <packtrace/renderer.hpp>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

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

/// Calls `work(x, y)`, which returns abi::RayCounts, for each tile's first pixel, from the
/// threads of the arena the call runs in. The sum is that of all tiles. Throws StopError as `done`
/// does.
template <class Work>
[[nodiscard]] FrameCounts for_each_tile(const TileGrid& grid, Progress& done, const Work& work)
{
    tbb::enumerable_thread_specific<abi::RayCounts> counts;
    tbb::parallel_for(
        tbb::blocked_range<int>(0, grid.count, 1),
        [&](const tbb::blocked_range<int>& tiles) {
            abi::RayCounts& sum = counts.local();
            for (int tile = tiles.begin(); tile != tiles.end() && !done.is_stopped(); ++tile) {
                sum += work(grid.first_column + tile % grid.columns * abi::tile_size,
                            grid.first_row + tile / grid.columns * abi::tile_size);
                done.finish_piece();
            }
        },
        tbb::simple_partitioner());
    done.check_stop();
    const abi::RayCounts sum =
        counts.combine([](abi::RayCounts a, const abi::RayCounts& b) { return a += b; });
    return {sum.camera, sum.shadow, sum.reflected, sum.refracted, sum.unsure, {sum.cut, sum.lacks}};
}

}  // namespace packtrace
