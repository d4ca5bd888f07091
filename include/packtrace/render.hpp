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

/// The number type in which rays are traced and colours are added.
enum class Precision {
    single,   ///< float
    double_,  ///< double
    extended  ///< long double, scalar kernel only
};

/// How float packets decide and compute their hits. Double packets and the scalar kernel do not
/// depend on it.
enum class Accuracy {
    fast,  ///< in single precision only
    exact  ///< decided in single precision if error bounds make that certain, otherwise in double;
           ///< every hit that shading or the caller needs is refined in double
};

/// How secondary and shadow rays avoid hitting the surface they start on.
enum class SelfHits {
    note,  ///< they start 0.001 along their direction, as in the notes
    exact  ///< for the surface they start on, the origin is a known root, and only the other root
           ///< can be a hit; for other surfaces, the origin is offset by a bound of the rounding
           ///< error, and hits count from t = 0
};

/// The default of packets and the scalar reference.
inline constexpr SelfHits default_self_hits = SelfHits::exact;

/// A part of a picture in pixels, counted from its upper left corner.
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

/// The scalar kernel rejects options marked "packet kernel" unless they have their defaults.
struct RenderOptions {
    Kernel kernel = Kernel::packet;
    std::string isa = "auto";             ///< packet kernel: see choose_isa()
    Accuracy accuracy = Accuracy::exact;  ///< packet kernel
    SelfHits self_hits = default_self_hits;
    int width = 0;  ///< packet kernel: float lanes 1, 4, 8 or 16; 0 is any
    Traversal traversal = Traversal::automatic;  ///< packet kernel
    /// Packet kernel: use the kernel with all features, and do not prune the scene. The picture is
    /// the same, bit for bit, unless objects coincide (docs/features.md).
    bool force_general = false;
    int threads = 0;  ///< 0: all threads of the TBB arena of the caller
    /// Samples per pixel, 1 … 1024. A single sample is at Camera::pixel_sample. Several samples are
    /// stratified, at the same positions in every pixel; the colour is their mean.
    int samples = 1;
    /// Adaptive sampling: the contrast, in [0, infinity), above which a pixel gets all `samples`.
    /// Every other pixel gets one sample at its centre. The contrast of a pixel is the largest
    /// difference of a channel to one of the eight neighbouring pixels, in a picture with one
    /// sample at each centre. Not set: every pixel gets all samples.
    std::optional<double> adaptive = {};
    /// Receives the share of the picture that is done, in [0, 1], from time to time. Calls may come
    /// from any thread, but one at a time.
    std::function<void(double)> progress = {};
    /// After a stop request, rendering throws StopError some tiles later (some pixels with the
    /// scalar kernel). The preparation of the scene is not interrupted.
    std::stop_token stop = {};
    /// The part to render, inside the picture. Not set: all of it. The image has the size of the
    /// region, and its pixels are those of the whole picture, bit for bit. Ray counts include all
    /// tiles of 16 x 16 pixels that overlap the region.
    std::optional<Region> region = {};
};

/// The rays of a picture that are not traced because of Scene::min_weight.
struct CutRays {
    std::uint64_t rays = 0;
    /// The largest possible difference of a channel to the picture with all rays traced, except for
    /// rounding errors of the pixels' sums (docs/numerics_derivations.md). With adaptive sampling
    /// this holds for pixels that have the same samples in both pictures.
    double bound = 0.0;
};

/// Renders a scene in the precision of `Real` (float or double; the scalar kernel also long
/// double). On a machine with fused multiply-add the picture does not depend on the width, the
/// traversal and the number of threads, bit for bit, except for last digits of transparent shadows
/// of several glass objects (docs/architecture.md). Throws std::invalid_argument for impossible
/// options, SceneError as validate() does, and StopError after a stop request. All kernels reject
/// the same scenes with the same messages. If `cut` is not null, it receives the rays that were
/// cut.
template <class Real>
[[nodiscard]] PACKTRACE_API Image<Real> render(const Scene& scene,
                                               const RenderOptions& options = {},
                                               CutRays* cut = nullptr);

}  // namespace packtrace
