#include "lab/truth/truth.hpp"

#include "core/atomic_file.hpp"
#include "core/checksum.hpp"
#include "lab/harness/stopwatch.hpp"
#include "lab/truth/truth_cache.hpp"
#include "reference/reference.hpp"
#include "reference/render_reference.hpp"
#include "scene/sample_pattern.hpp"

namespace packtrace {
namespace {

// Pixels of a cached truth that are traced again.
constexpr int checked_pixels = 32;

// The fractions of its multiples are spread evenly.
constexpr double golden_ratio = 0.6180339887498949;

std::filesystem::path file_of(const std::string& key, const std::filesystem::path& cache)
{
    return cache / (text_hash_digits(key) + ".truth");
}

reference::Color<double> color_now(const Scene& scene, int samples, int x, int y)
{
    if (samples > 1)
        return reference::Reference<double>(scene).trace_samples(x, y, sample_pattern(samples));
    const auto color = reference::Reference<long double>(scene).trace_pixel(x, y);
    return {static_cast<double>(color.x), static_cast<double>(color.y),
            static_cast<double>(color.z)};
}

// Finds changes of the reference that the key does not show.
bool still_true(const Truth& truth, const Scene& scene, int samples)
{
    if (truth.image.width != scene.width || truth.image.height != scene.height)
        return false;
    for (int i = 0; i < checked_pixels; ++i) {
        const double column = i * golden_ratio;
        const int x = static_cast<int>((column - static_cast<int>(column)) * scene.width);
        const int y = (2 * i + 1) * scene.height / (2 * checked_pixels);
        const auto color = color_now(scene, samples, x, y);
        const double* pixel = truth.image.pixel(x, y);
        if (pixel[0] != color.x || pixel[1] != color.y || pixel[2] != color.z)
            return false;
    }
    return true;
}

Image<double> trace_truth(const Scene& scene, int samples, const RenderOptions& usual)
{
    RenderOptions options = usual;
    options.samples = samples;
    if (samples > 1)
        return render_reference<double>(scene, options);
    return convert<double>(render_reference<long double>(scene, options));
}

std::string what_of(const TruthRequest& request)
{
    return request.samples > 1
               ? "scalar reference, double, " + std::to_string(request.samples) + " samples a pixel"
               : "scalar reference, long double, the scene's one sample a pixel";
}

}  // namespace

std::optional<Truth> kept_truth(const Scene& scene, const TruthRequest& request)
{
    if (request.cache.empty())
        return std::nullopt;
    const std::string key = truth_key(scene, request.samples).text();
    std::optional<Truth> truth = read_truth(file_of(key, request.cache), key);
    if (!truth || !still_true(*truth, scene, request.samples))
        return std::nullopt;
    truth->what = what_of(request);
    return truth;
}

Image<double> truth_rows(const Scene& scene, int samples, int first, int rows)
{
    return trace_truth(scene, samples, {.region = Region{0, first, scene.width, rows}});
}

void keep_truth(const Scene& scene, const TruthRequest& request, Truth& truth)
{
    truth.what = what_of(request);
    if (request.cache.empty())
        return;
    make_folders(request.cache);
    const std::string key = truth_key(scene, request.samples).text();
    write_truth(file_of(key, request.cache), key, truth);
}

Truth find_truth(const Scene& scene, const TruthRequest& request)
{
    if (std::optional<Truth> kept = kept_truth(scene, request))
        return *kept;
    const RenderOptions options{.progress = request.progress, .stop = request.stop};
    Truth truth;
    truth.seconds = seconds_of(options.threads,
                               [&] { truth.image = trace_truth(scene, request.samples, options); });
    keep_truth(scene, request, truth);
    return truth;
}

}  // namespace packtrace
