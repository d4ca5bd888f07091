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
    double seconds = 0.0;  ///< that rendering it took
    bool cached = false;   ///< read from a file
};

struct TruthRequest {
    int samples = 1;                   ///< per pixel; 1 is the scene's own sample
    std::filesystem::path cache = {};  ///< folder; empty for no cache
    std::function<void(double)> progress = {};
    std::stop_token stop = {};  ///< see RenderOptions::stop
};

/// The scalar reference's picture: in long double at one sample per pixel, in double at more. A
/// cached file is used only if it has the key of all that the truth depends on (truth_cache.hpp),
/// its checksum is right, and some of its pixels equal those of the reference now; else the truth
/// is made anew. Throws FileError if it cannot be written to the cache, and std::invalid_argument
/// for a scene that has no text to be its key (write_scene.hpp).
[[nodiscard]] Truth find_truth(const Scene& scene, const TruthRequest& request);

// The steps of find_truth(), for truths whose rows are traced by several programs.

/// A truth from the cache, if there is a valid one.
[[nodiscard]] std::optional<Truth> kept_truth(const Scene& scene, const TruthRequest& request);

/// `rows` rows of a truth from row `first` on, with the same bits as in the whole truth.
[[nodiscard]] Image<double> truth_rows(const Scene& scene, int samples, int first, int rows);

/// Sets Truth::what of a new truth, and writes it to the cache.
void keep_truth(const Scene& scene, const TruthRequest& request, Truth& truth);

}  // namespace packtrace
