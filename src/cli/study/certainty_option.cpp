#include "cli/output/distinct_files.hpp"
#include "cli/render/render_picture.hpp"
#include "cli/study/study.hpp"
#include "image/formats.hpp"
#include "lab/harness/machine.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/certainty.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace packtrace::cli {
namespace {

/// The longest edge of the picture whose rays `info` counts.
constexpr int sample_edge = 128;

/// Bytes per pixel: the counts, and twice the picture of them, because its file is encoded as a
/// whole.
constexpr double certainty_bytes = sizeof(PixelCertainty) + 2 * 3 * sizeof(float);

std::uint64_t unsure_total(const UnsureCounts& counts)
{
    std::uint64_t sum = 0;
    for (const std::uint64_t count : counts)
        sum += count;
    return sum;
}

/// "3 of 1000 rays (0.3 %)"
std::string share_text(std::uint64_t part, std::uint64_t rays)
{
    char text[96];
    std::snprintf(text, sizeof text, "%llu of %llu rays (%.2g %%)",
                  static_cast<unsigned long long>(part), static_cast<unsigned long long>(rays),
                  rays > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(rays) : 0.0);
    return text;
}

}  // namespace

void check_certainty(const RenderArguments& arguments, const RenderOptions& options)
{
    const auto fail = [](const std::string& why) {
        throw CLI::ValidationError("--certainty: " + why);
    };
    if (options.kernel == Kernel::scalar)
        fail("the scalar kernel traces no ray again in double; leave out --kernel scalar");
    if (chosen_precision(arguments.kernel.precision) != Precision::single)
        fail("--precision " + arguments.kernel.precision +
             " decides nothing in single precision; leave it out");
    if (options.accuracy != Accuracy::exact)
        fail("--accuracy fast traces no ray again in double; leave it out");
    if (options.adaptive)
        fail("with --adaptive pixels have different numbers of rays; give --spp alone");
    if (arguments.animation.many())
        fail("it is of one picture; give --frame N in place of --frames or --y4m");
    check_two_files(arguments.output, *arguments.certainty);
    check_not_read(*arguments.certainty, {arguments.scene});
    check_image_writable(*arguments.certainty);
}

void check_certainty_size(const Scene& scene)
{
    const double needed = certainty_bytes * scene.width * scene.height;
    if (const double limit = memory_limit(); needed > limit)
        throw CLI::ValidationError("--certainty: " + std::to_string(scene.width) + " x " +
                                   std::to_string(scene.height) + " pixels take " +
                                   gigabytes(needed) + " of memory, of which there are " +
                                   gigabytes(limit) + "; give a smaller --size or leave it out");
}

std::string write_certainty(const RenderArguments& arguments, const Scene& scene,
                            const RenderOptions& options)
{
    const Certainty certainty = find_certainty(scene, options);
    ImageWriteOptions write = arguments.write;
    if (image_format(*arguments.certainty) != ImageFormat::png)
        write.gamma = 1.0;
    write_image(*arguments.certainty, certainty_picture(certainty), write);
    return language::escape(*arguments.certainty) + ": red, traced again in double: " +
           share_text(unsure_total(certainty.unsure), certainty.rays.total()) +
           "; blue, undecided by double, too: " +
           share_text(certainty.undecided, certainty.rays.total());
}

std::optional<UnsureSample> sample_unsure(const Scene& scene, const std::string& isa)
{
    Scene small = scene;
    const double shrink =
        std::min(1.0, static_cast<double>(sample_edge) / std::max(scene.width, scene.height));
    small.width = std::max(1, static_cast<int>(std::lround(shrink * scene.width)));
    small.height = std::max(1, static_cast<int>(std::lround(shrink * scene.height)));
    const Certainty certainty = find_certainty(small, {.isa = isa});
    UnsureSample sample{small.width, small.height, certainty.rays.total(), {}};
    for (std::size_t cause = 0; cause < certainty.unsure.size(); ++cause)
        sample.causes.emplace_back(unsure_causes()[cause], certainty.unsure[cause]);
    return sample;
}

}  // namespace packtrace::cli
