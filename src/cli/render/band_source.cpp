#include "cli/render/band_source.hpp"

#include <algorithm>

#include "kernel_abi/kernel_table.hpp"
#include "render/row_renderer.hpp"

namespace packtrace::cli {
namespace {

template <class Real>
class RenderedBands final : public BandSource {
public:
    RenderedBands(const Scene& scene, const RenderOptions& options, const RowSamples& samples)
        : renderer_(scene, options), samples_(samples), width_(scene.width)
    {
    }

    FrameCounts render(const Bands::Band& band, std::span<std::uint8_t> samples) override
    {
        if (image_.height != band.rows)
            image_ = Image<Real>::unset(width_, band.rows);
        const FrameCounts counts = renderer_.render(band.first, image_);
        samples_.encode(std::span<const Real>(image_.rgb), samples.data());
        return counts;
    }

private:
    RowRenderer<Real> renderer_;
    RowSamples samples_;
    int width_;
    Image<Real> image_;
};

}  // namespace

Bands cut_into_bands(int width, int height, ImageFormat format, std::int64_t pixels)
{
    const std::int64_t tile_row = std::int64_t{abi::tile_size} * width;
    const std::int64_t tiles = std::clamp<std::int64_t>(pixels / tile_row, 1, 4096);
    return {width, height, static_cast<int>(tiles) * abi::tile_size, RowFile::begins_below(format)};
}

std::unique_ptr<BandSource> band_source(const Scene& scene, const std::string& precision,
                                        const RenderOptions& options, const RowSamples& samples)
{
    if (precision == "double")
        return std::make_unique<RenderedBands<double>>(scene, options, samples);
    if (precision == "extended")
        return std::make_unique<RenderedBands<long double>>(scene, options, samples);
    return std::make_unique<RenderedBands<float>>(scene, options, samples);
}

}  // namespace packtrace::cli
