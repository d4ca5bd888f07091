#include "camera_tiles.hpp"

#include "pass_timer.hpp"
#include "render/camera_view.hpp"

#include <algorithm>

namespace packtrace::peers {

CameraTiles::CameraTiles(const Scene& scene, const std::string& isa, Accuracy accuracy)
    : lowered_(lower(scene, accuracy)),
      packed_(lowered_, frame_traversal(lowered_, Traversal::automatic,
                                        precision<float>(kernels_of(isa)).lanes)),
      camera_(camera_view<float>(scene, lowered_)),
      kernels_(kernels_for(precision<float>(kernels_of(isa)), lowered_.features)),
      scratch_(kernels_.scratch_bytes(packed_.view(), 1)),
      width_(scene.width),
      height_(scene.height)
{
    // As for all other tracers of this program.
    camera_.t_min = 0.0F;
    job_.scene = &packed_.view();
    job_.camera = &camera_;
    job_.scratch = scratch_.data();
}

double CameraTiles::trace(Hits& hits)
{
    // Times a row of tiles at once, so that reading the clock takes no noticeable time.
    std::vector<abi::TileHits<float>> row(static_cast<std::size_t>(width_ / tile_size));
    PassTimer watch;
    std::size_t first = 0;
    for (job_.y = 0; job_.y < height_; job_.y += tile_size) {
        watch.measure([&] {
            for (std::size_t i = 0; i < row.size(); ++i) {
                job_.x = static_cast<int>(i) * tile_size;
                kernels_.closest_tile(job_, row[i]);
            }
        });
        for (const abi::TileHits<float>& tile : row) {
            // A scene of spheres has one surface an object.
            std::copy_n(tile.t, tile_pixels, hits.t.begin() + static_cast<std::ptrdiff_t>(first));
            std::copy_n(tile.surface, tile_pixels,
                        hits.object.begin() + static_cast<std::ptrdiff_t>(first));
            first += tile_pixels;
        }
    }
    return watch.seconds();
}

}  // namespace packtrace::peers
