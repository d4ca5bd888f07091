#include "study/filled_lanes.hpp"

#include "dispatch/kernels.hpp"
#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"

namespace packtrace {
namespace {

// Rays and the lanes of the packets that hold them.
struct Filling {
    std::uint64_t rays = 0;
    std::uint64_t lanes = 0;

    void add(std::uint64_t count, int width)
    {
        const auto lanes_of_packet = static_cast<std::uint64_t>(width);
        rays += count;
        lanes += (count + lanes_of_packet - 1) / lanes_of_packet * lanes_of_packet;
    }
    [[nodiscard]] double share() const
    {
        return lanes > 0 ? static_cast<double>(rays) / static_cast<double>(lanes) : 0.0;
    }
};

// The tiles' mirrored rays, of a frame that ends after `depth`.
template <class Real>
std::vector<std::uint64_t> mirrored_rays(const Scene& scene, LoweredScene lowered, int depth,
                                         const abi::KernelTable& table)
{
    lowered.max_depth = depth;
    const TileRenderer<Real> tiles(scene, lowered, table, {});
    const TileGrid grid(scene.width, scene.height);
    Image<Real> image(scene.width, scene.height);
    std::vector<std::uint64_t> counts;
    for (int tile = 0; tile < grid.count; ++tile)
        counts.push_back(tiles
                             .render_once(image, tile % grid.columns * abi::tile_size,
                                          tile / grid.columns * abi::tile_size)
                             .reflected);
    return counts;
}

// Camera rays follow the tile's Z-order curve, with gaps where it leaves the picture: a packet is
// a block of 2, 4, 8 or 16 pixels, 2x1, 2x2, 4x2 or 4x4.
double camera_share(const Scene& scene, int width)
{
    int columns = 1;
    int rows = 1;
    for (int lanes = 1; lanes < width; lanes *= 2)
        (columns == rows ? columns : rows) *= 2;
    const auto blocks = [](int size, int of) { return (size + of - 1) / of; };
    const double covered = static_cast<double>(blocks(scene.width, columns) * columns) *
                           (blocks(scene.height, rows) * rows);
    return static_cast<double>(scene.width) * scene.height / covered;
}

}  // namespace

template <class Real>
std::optional<std::vector<double>> filled_lanes(const Scene& scene, const LoweredScene& lowered,
                                                const abi::KernelTable& table)
{
    if (lowered.features.glass)
        return std::nullopt;
    const int width = precision<Real>(table).lanes;
    std::vector<double> shares{camera_share(scene, width)};
    std::vector<std::uint64_t> before = mirrored_rays<Real>(scene, lowered, 0, table);
    for (int depth = 1; depth <= lowered.max_depth; ++depth) {
        const auto now = mirrored_rays<Real>(scene, lowered, depth, table);
        Filling filling;
        for (std::size_t tile = 0; tile < now.size(); ++tile)
            filling.add(now[tile] - before[tile], width);
        shares.push_back(filling.share());
        before = now;
    }
    return shares;
}

template std::optional<std::vector<double>> filled_lanes<float>(const Scene&, const LoweredScene&,
                                                                const abi::KernelTable&);
template std::optional<std::vector<double>> filled_lanes<double>(const Scene&, const LoweredScene&,
                                                                 const abi::KernelTable&);

}  // namespace packtrace
