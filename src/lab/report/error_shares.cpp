#include "image/pixel_error.hpp"
#include "lab/report/error_class.hpp"

#include <algorithm>
#include <array>

namespace packtrace {
namespace {

// Smaller errors are rounding errors of double.
constexpr double rounding = 1e-12;

std::vector<PixelError> errors_above(double threshold, const Image<double>& truth,
                                     const Image<double>& picture)
{
    std::vector<PixelError> errors;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            const double error = pixel_error(truth.pixel(x, y), picture.pixel(x, y));
            if (error > threshold)
                errors.push_back({x, y, error});
        }
    return errors;
}

std::vector<PixelError> evenly_spread(const std::vector<PixelError>& all, int wanted)
{
    const auto count = std::min(all.size(), static_cast<std::size_t>(wanted));
    std::vector<PixelError> some;
    for (std::size_t i = 0; i < count; ++i)
        some.push_back(all[i * all.size() / count]);
    return some;
}

std::vector<PixelError> worst_of(std::vector<PixelError> all, int wanted)
{
    std::stable_sort(all.begin(), all.end(),
                     [](const PixelError& a, const PixelError& b) { return a.error > b.error; });
    all.resize(std::min(all.size(), static_cast<std::size_t>(wanted)));
    return all;
}

}  // namespace

void find_shares(ReportRun& run, const Image<double>& truth, const Image<double>& picture,
                 const ReportOptions& options, const ClassOfPixel& class_of)
{
    run.looked_at_off = run.error.pixels_off > 0;
    const auto pixels =
        run.looked_at_off
            ? evenly_spread(errors_above(options.threshold, truth, picture), options.classified)
            : worst_of(errors_above(rounding, truth, picture), options.classified);
    std::array<ErrorShare, error_class_count> shares;
    double sum = 0.0;
    for (const PixelError& pixel : pixels) {
        const auto found = class_of(pixel.x, pixel.y);
        if (!found)
            continue;
        ErrorShare& share = shares[static_cast<std::size_t>(found->kind)];
        ++share.pixels;
        ++run.looked_at;
        share.squared_error += pixel.error * pixel.error;
        sum += pixel.error * pixel.error;
    }
    for (int kind = 0; kind < error_class_count; ++kind) {
        ErrorShare& share = shares[static_cast<std::size_t>(kind)];
        share.kind = name_of(static_cast<ErrorClass>(kind));
        share.meaning = meaning_of(static_cast<ErrorClass>(kind));
        if (share.pixels == 0)
            continue;
        share.squared_error /= sum;
        run.shares.push_back(share);
    }
    std::stable_sort(run.shares.begin(), run.shares.end(),
                     [](const ErrorShare& a, const ErrorShare& b) { return a.pixels > b.pixels; });
}

}  // namespace packtrace
