#include <packtrace/explain.hpp>

#include <algorithm>
#include <stdexcept>
#include <type_traits>

#include <packtrace/isa.hpp>

#include "core/aligned_array.hpp"
#include "dispatch/kernels.hpp"
#include "lower/packed_scene.hpp"
#include "reference/explain_reference.hpp"
#include "render/camera_view.hpp"
#include "study/packet_tree.hpp"

namespace packtrace {
namespace {

void check_pixel(const Scene& scene, int x, int y)
{
    if (x < 0 || x >= scene.width || y < 0 || y >= scene.height)
        throw std::invalid_argument("explain: pixel " + std::to_string(x) + "," +
                                    std::to_string(y) + " lies outside the picture of " +
                                    std::to_string(scene.width) + " x " +
                                    std::to_string(scene.height));
}

template <class Real>
void check_depth(const Scene& scene)
{
    if (scene.max_depth > abi::longest_path<Real>)
        throw std::invalid_argument(
            "explain: max_depth is " + std::to_string(scene.max_depth) +
            ", and packets in this precision number the rays of a tree down to " +
            std::to_string(abi::longest_path<Real>) + "; give a lower depth");
}

// Column and row in turns, from the lowest bit.
int z_order(int column, int row)
{
    int number = 0;
    for (int bit = 0; (1 << bit) < abi::tile_size; ++bit)
        number |= (((column >> bit) & 1) | (((row >> bit) & 1) << 1)) << (2 * bit);
    return number;
}

// The pixel's whole tile is rendered, in the packets it always shares with its neighbours.
template <class Real>
RayNode explain_packets(const Scene& scene, int x, int y, const RenderOptions& options)
{
    const LoweredScene lowered = lower(scene);
    const PackedScene<Real> packed(lowered);
    const abi::CameraView<Real> camera = camera_view<Real>(scene, lowered);
    const auto& table = precision<Real>(kernels_of(choose_isa(options.isa, options.width).name));
    const abi::FeatureKernels<Real>& kernels =
        kernels_for(table, {.quadrics = true, .glass = true, .probe = true});
    AlignedArray<std::byte> scratch(kernels.scratch_bytes(packed.view()));
    PacketTree<Real> tree(scene);
    const int column = x % abi::tile_size;
    const int row = y % abi::tile_size;
    const abi::Probe<Real> probe = tree.probe(z_order(column, row));
    Real rgb[3 * abi::tile_pixels];

    abi::TileJob<Real> job;
    job.scene = &packed.view();
    job.camera = &camera;
    job.x = x - column;
    job.y = y - row;
    job.width = std::min(abi::tile_size, scene.width - job.x);
    job.height = std::min(abi::tile_size, scene.height - job.y);
    job.rgb = rgb;
    job.row_stride = 3 * abi::tile_size;
    job.scratch = scratch.data();
    job.probe = &probe;
    (void)kernels.render_tile(job);
    return tree.root();
}

}  // namespace

template <class Real>
RayNode explain_pixel(const Scene& scene, int x, int y, const RenderOptions& options)
{
    check_pixel(scene, x, y);
    if (options.kernel == Kernel::packet) {
        check_depth<Real>(scene);
        return explain_packets<Real>(scene, x, y, options);
    }
    if constexpr (!std::is_same_v<Real, double>)
        throw std::invalid_argument("explain: the scalar kernel is explained in double only");
    return explain_reference(scene, x, y);
}

template RayNode explain_pixel<float>(const Scene&, int, int, const RenderOptions&);
template RayNode explain_pixel<double>(const Scene&, int, int, const RenderOptions&);

Rgb sum_of(const RayNode& tree)
{
    Rgb sum = tree.weight * (tree.local + tree.brought);
    for (const RayNode& child : tree.children)
        sum += sum_of(child);
    return sum;
}

}  // namespace packtrace
