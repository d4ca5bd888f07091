#include "dispatch/kernels.hpp"
#include "kernel_abi/probe.hpp"
#include "lab/harness/ray_trees.hpp"
#include <packtrace/explain.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/validate.hpp>

#include <stdexcept>
#include <type_traits>

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

}  // namespace

template <class Real>
RayNode explain_pixel(const Scene& scene, int x, int y, const RenderOptions& options)
{
    check_pixel(scene, x, y);
    if (options.kernel == Kernel::packet) {
        check_depth<Real>(scene);
        const IsaInfo isa = choose_isa(options.isa, options.width);
        const LoweredScene lowered = lower_for<Real>(scene, options);
        return packet_trees<Real>(scene, lowered, kernels_of(isa.name))(x, y);
    }
    if constexpr (!std::is_same_v<Real, double>)
        throw std::invalid_argument("explain: the scalar kernel is explained in double only");
    validate(scene);
    return reference_trees<double>(scene, options.self_hits)(x, y);
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
