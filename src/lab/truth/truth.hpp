#pragma once

#include <packtrace/image.hpp>
#include <packtrace/scene.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

namespace packtrace {

struct Truth {
    Image<double> image;
    std::string what;
    double seconds = 0.0;  ///< that it took when it was made
    bool cached = false;   ///< taken from a file
};

struct TruthRequest {
    int samples = 1;                   ///< a pixel; one is the scene's own
    std::filesystem::path cache = {};  ///< folder; nothing is kept where empty
    std::function<void(double)> progress = {};
    std::stop_token stop = {};  ///< as RenderOptions has it
};

/// The scalar reference's picture: in long double at one sample a pixel, in double at more. A file
/// of the cache is used only if it has the key of all that the truth depends on (truth_cache.hpp),
/// its bytes agree with their checksum, and some of its pixels with what the reference gives now;
/// else it is made anew. Throws FileError when it can't be kept, and std::invalid_argument for a
/// scene to be kept that has no text (write_scene.hpp).
[[nodiscard]] Truth find_truth(const Scene& scene, const TruthRequest& request);

// The steps of find_truth(), for a truth whose rows are traced by several programs.

/// A truth of the cache that may be used.
[[nodiscard]] std::optional<Truth> kept_truth(const Scene& scene, const TruthRequest& request);

/// So many rows of a truth from `first` on. They have the bits of the whole truth.
[[nodiscard]] Image<double> truth_rows(const Scene& scene, int samples, int first, int rows);

/// Names a truth that was made, and keeps it in the cache.
void keep_truth(const Scene& scene, const TruthRequest& request, Truth& truth);

}  // namespace packtrace
