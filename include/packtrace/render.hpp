#pragma once

#include <functional>
#include <optional>
#include <string>

#include <packtrace/image.hpp>
#include <packtrace/scene.hpp>
#include <packtrace/traversal.hpp>

namespace packtrace {

enum class Kernel { packet, scalar };

struct RenderOptions {
    Kernel kernel = Kernel::packet;
    std::string isa = "auto";  ///< packet kernel: see choose_isa
    int width = 0;             ///< packet kernel: float lanes 4, 8 or 16; 0 is any
    Traversal traversal = Traversal::automatic;  ///< packet kernel
    int threads = 0;           ///< 0: all of the TBB arena the call runs in
    /// Samples a pixel, 1 … 1024. One lies where the scene's camera says; more lie in the same
    /// stratified places of every pixel, whose colour is their mean.
    int samples = 1;
    /// Contrast in [0, infinity) above which a pixel gets its `samples`; all others get one in
    /// their centre. Contrast is the largest difference of a channel from one of the eight
    /// neighbouring pixels, of a picture with one sample in each centre. Not set: every pixel gets
    /// all samples.
    std::optional<double> adaptive = {};
    /// Called now and then with the share of the picture done, in [0, 1]; may be called from
    /// any thread, one at a time.
    std::function<void(double)> progress = {};
};

/// Renders a scene in the precision of `Real` (float or double; the scalar kernel also long
/// double). The picture is the same, bit for bit, whatever the width and number of threads on
/// a machine with fused multiply-add. Throws std::invalid_argument for impossible options.
template <class Real>
[[nodiscard]] Image<Real> render(const Scene& scene, const RenderOptions& options = {});

}  // namespace packtrace
