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

/// A picture divided into bands of some rows. Bands can be rendered in any order.
struct Bands {
    int width = 0;       ///< pixels
    int height = 0;      ///< pixels
    int rows = 0;        ///< rows of each band except the last
    bool below = false;  ///< bands are numbered from the picture's last row, where the file begins

    struct Band {
        int first = 0;  ///< uppermost row
        int rows = 0;
    };

    [[nodiscard]] int count() const
    {
        return (height + rows - 1) / rows;
    }
    /// The band with this number, in the file's order.
    [[nodiscard]] Band band(int number) const
    {
        const int first = rows * (below ? count() - 1 - number : number);
        return {first, first + rows <= height ? rows : height - first};
    }
};

/// Divides a picture into bands of about `pixels` pixels each. Bands are whole tiles, except at the
/// picture's end.
[[nodiscard]] Bands cut_into_bands(int width, int height, ImageFormat format, std::int64_t pixels);

/// The pixels of a band: enough work for all threads in little memory. Journals depend on it.
inline constexpr std::int64_t band_pixels = std::int64_t{1} << 18;

/// Pictures with more pixels are not held in memory as a whole.
inline constexpr std::int64_t most_whole_pixels = std::int64_t{1} << 24;

/// Writes the samples of a band to `samples`. Only packets count their rays; all kernels count the
/// rays that are cut.
using RenderBand =
    std::function<FrameCounts(const Bands::Band& band, std::span<std::uint8_t> samples)>;

/// Throws as render() does. `options.progress`, if any, receives the share of a band.
[[nodiscard]] RenderBand band_renderer(const Scene& scene, Precision precision,
                                       const RenderOptions& options, const RowSamples& samples);

/// The times of a picture in bands.
struct BandTally {
    double rendering = 0.0;  ///< seconds
    double writing = 0.0;    ///< seconds, mostly while the next band renders
    CutRays cut;
    int bands = 0;
    int found = 0;  ///< bands that an earlier run finished
};

/// Prints on standard error how many bands of `output` an earlier run finished, if any.
inline void print_found_bands(const std::string& output, int found, int bands)
{
    if (found > 0)
        std::cerr << language::escape(output) << ": " << found << " of " << bands
                  << " bands were finished by an earlier run\n";
}

/// Renders a picture band by band to its file. Memory does not grow with the picture's height. With
/// `--resume`, finished bands are kept beside the file until it is complete, and bands of an
/// earlier run are reused.
[[nodiscard]] BandTally render_bands(const RenderArguments& arguments, const Scene& scene,
                                     const RenderOptions& options);

}  // namespace packtrace::cli
