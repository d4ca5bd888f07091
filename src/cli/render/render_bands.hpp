#pragma once

#include "cli/render/render_arguments.hpp"
#include "image/row_file.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/render.hpp>
#include <packtrace/renderer.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>
#include <functional>
#include <iostream>
#include <span>
#include <string>

namespace packtrace::cli {

/// A picture in bands: some rows at a time, in any order.
struct Bands {
    int width = 0;       ///< pixels
    int height = 0;      ///< pixels
    int rows = 0;        ///< of each, but for the last one's
    bool below = false;  ///< numbered from the picture's last row, as files that begin there are

    struct Band {
        int first = 0;  ///< its uppermost row
        int rows = 0;
    };

    [[nodiscard]] int count() const
    {
        return (height + rows - 1) / rows;
    }
    /// By its number in the file's order.
    [[nodiscard]] Band band(int number) const
    {
        const int first = rows * (below ? count() - 1 - number : number);
        return {first, first + rows <= height ? rows : height - first};
    }
};

/// Of about `pixels` pixels each: whole tiles, the last row of which may be the picture's.
[[nodiscard]] Bands cut_into_bands(int width, int height, ImageFormat format, std::int64_t pixels);

/// Pixels of a band: enough for all threads, little memory. Journals depend on it.
inline constexpr std::int64_t band_pixels = std::int64_t{1} << 18;

/// Pictures of more pixels are not held whole.
inline constexpr std::int64_t most_whole_pixels = std::int64_t{1} << 24;

/// Fills `samples` with those of a band. Its rays are known of packets alone; what is cut of all
/// kernels.
using RenderBand =
    std::function<FrameCounts(const Bands::Band& band, std::span<std::uint8_t> samples)>;

/// Throws as render() does. `options.progress`, if any, is called with the share of a band.
[[nodiscard]] RenderBand band_renderer(const Scene& scene, Precision precision,
                                       const RenderOptions& options, const RowSamples& samples);

/// What a picture in bands took.
struct BandTally {
    double rendering = 0.0;  ///< seconds
    double writing = 0.0;    ///< seconds, mostly while the next band renders
    CutRays cut;
    int bands = 0;
    int found = 0;  ///< of them finished by an earlier run
};

/// Says on standard error how many bands of `output` an earlier run has finished, if any.
inline void print_found_bands(const std::string& output, int found, int bands)
{
    if (found > 0)
        std::cerr << language::escape(output) << ": " << found << " of " << bands
                  << " bands were finished by an earlier run\n";
}

/// Renders a picture band by band into its file. Memory does not grow with its height. With
/// `--resume`, finished bands are kept beside it until it is complete, and those of an earlier run
/// are taken.
[[nodiscard]] BandTally render_bands(const RenderArguments& arguments, const Scene& scene,
                                     const RenderOptions& options);

}  // namespace packtrace::cli
