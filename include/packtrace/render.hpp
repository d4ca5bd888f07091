#pragma once

#include <packtrace/export.hpp>
#include <packtrace/image.hpp>
#include <packtrace/scene.hpp>
#include <packtrace/stop.hpp>
#include <packtrace/traversal.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

namespace packtrace {

enum class Kernel { packet, scalar };

/// The numbers that rays are traced and colours are added in.
enum class Precision {
    single,   ///< float
    double_,  ///< double
    extended  ///< long double, which the scalar kernel alone has
};

/// How float packets decide and place their hits. Packets of doubles and the scalar kernel are the
/// same in both modes.
enum class Accuracy {
    fast,  ///< in single precision alone
    exact  ///< decided in single precision where error bounds make that certain, in double where
           ///< not; every hit that shading or the caller asks for is refined in double
};

/// How secondary and shadow rays avoid hitting the surface they start on.
enum class SelfHits {
    note,  ///< they start 0.001 along their direction, as the notes have it
    exact  ///< their own surface is solved as one they are on; they hit others, from t = 0 on,
           ///< from as far off it as rounding can do
};

/// What counts where nothing is said, in packets and the scalar reference alike.
inline constexpr SelfHits default_self_hits = SelfHits::exact;

/// A part of a picture, pixels, counted from its upper left corner.
struct Region {
    int x = 0;
    int y = 0;
    int width = 1;   ///< 1 or more
    int height = 1;  ///< 1 or more

    [[nodiscard]] bool contains(int column, int row) const
    {
        return column >= x && column < x + width && row >= y && row < y + height;
    }
    [[nodiscard]] bool operator==(const Region&) const = default;
};

/// What is marked "packet kernel" the scalar kernel refuses, but for the defaults.
struct RenderOptions {
    Kernel kernel = Kernel::packet;
    std::string isa = "auto";             ///< packet kernel: see choose_isa
    Accuracy accuracy = Accuracy::exact;  ///< packet kernel
    SelfHits self_hits = default_self_hits;
    int width = 0;  ///< packet kernel: float lanes 1, 4, 8 or 16; 0 is any
    Traversal traversal = Traversal::automatic;  ///< packet kernel
    /// Packet kernel: run the one that knows everything, and leave nothing out of the scene. The
    /// picture is the same, bit for bit, unless objects share one place (docs/features.md).
    bool force_general = false;
    int threads = 0;  ///< 0: all of the TBB arena the call runs in
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
    /// When a stop is requested rendering throws StopError, some tiles later, or some pixels with
    /// the scalar kernel. A scene is made ready to the end.
    std::stop_token stop = {};
    /// Within the picture. Not set: all of it. The image has the region's size, and its pixels have
    /// the bits they have in the whole picture. Rays are counted of all tiles of 16 x 16 pixels
    /// that it has a part of.
    std::optional<Region> region = {};
};

/// The rays of a picture that are not traced, as Scene::min_weight asks.
struct CutRays {
    std::uint64_t rays = 0;
    /// No channel of any pixel differs by more from the picture in which all rays are traced, but
    /// for the rounding of the pixels' sums (docs/numerics_derivations.md). Adaptive sampling: of
    /// pixels with the same samples.
    double bound = 0.0;
};

/// Renders a scene in the precision of `Real` (float or double; the scalar kernel also long
/// double). The picture is the same, bit for bit, whatever the width, the traversal and
/// the number of threads on a machine with fused multiply-add, but for last digits of transparent
/// shadows of several bodies of glass (docs/architecture.md). Throws std::invalid_argument for
/// impossible options, and SceneError as validate() does; every kernel refuses the same scenes with
/// the same words. `cut`, if any, is set.
template <class Real>
[[nodiscard]] PACKTRACE_API Image<Real> render(const Scene& scene,
                                               const RenderOptions& options = {},
                                               CutRays* cut = nullptr);

}  // namespace packtrace
