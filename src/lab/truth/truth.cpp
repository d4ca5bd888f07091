#include "lab/truth/truth.hpp"

#include <packtrace/version.hpp>
#include <packtrace/write_scene.hpp>

#include "core/atomic_file.hpp"
#include "core/text_hash.hpp"
#include "lab/harness/machine.hpp"
#include "lab/harness/stopwatch.hpp"
#include "lab/truth/truth_file.hpp"
#include "reference/reference.hpp"
#include "reference/render_reference.hpp"
#include "scene/sample_pattern.hpp"

namespace packtrace {
namespace {

// Pixels of a cached truth that are traced again.
constexpr int checked_pixels = 32;

// Named for all that the truth depends on: the scene with its camera, size and depth, the samples,
// the program and its compiler.
std::filesystem::path file_of(const Scene& scene, const TruthRequest& request)
{
    const std::string key = PACKTRACE_VERSION_STRING " " + commit_name() + ", " + compiler_name() +
                            ", " + std::to_string(request.samples) + " samples\n" +
                            scene_text(scene);
    char name[32];
    std::snprintf(name, sizeof name, "%016llx.truth",
                  static_cast<unsigned long long>(text_hash(key)));
    return request.cache / name;
}

reference::Color<double> color_now(const Scene& scene, int samples, int x, int y)
{
    if (samples > 1)
        return reference::Reference<double>(scene).trace_samples(x, y, sample_pattern(samples));
    const auto color = reference::Reference<long double>(scene).trace_pixel(x, y);
    return {static_cast<double>(color.x), static_cast<double>(color.y),
            static_cast<double>(color.z)};
}

// A reference that was changed since would be found out.
bool still_true(const Truth& truth, const Scene& scene, int samples)
{
    if (truth.image.width != scene.width || truth.image.height != scene.height)
        return false;
    for (int i = 0; i < checked_pixels; ++i) {
        // Along the diagonals of a grid that visits all columns and rows.
        const int x = static_cast<int>(
            (i * 0.6180339887498949 - static_cast<int>(i * 0.6180339887498949)) * scene.width);
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
    std::optional<Truth> truth = read_truth(file_of(scene, request));
    if (!truth || !still_true(*truth, scene, request.samples))
        return std::nullopt;
    truth->what = what_of(request);
    return truth;
}

Image<double> truth_rows(const Scene& scene, int samples, int first, int rows)
{
    RenderOptions options;
    options.region = Region{0, first, scene.width, rows};
    return trace_truth(scene, samples, options);
}

void keep_truth(const Scene& scene, const TruthRequest& request, Truth& truth)
{
    truth.what = what_of(request);
    if (request.cache.empty())
        return;
    make_folders(request.cache);
    write_truth(file_of(scene, request), truth);
}

Truth find_truth(const Scene& scene, const TruthRequest& request)
{
    if (std::optional<Truth> kept = kept_truth(scene, request))
        return *kept;
    RenderOptions options;
    options.progress = request.progress;
    Truth truth;
    truth.seconds = seconds_of(options.threads,
                               [&] { truth.image = trace_truth(scene, request.samples, options); });
    keep_truth(scene, request, truth);
    return truth;
}

}  // namespace packtrace
