#include <algorithm>
#include <cstdio>
#include <string>

#include <packtrace/profile.hpp>

#include "image/color_ramp.hpp"
#include "image/legend.hpp"
#include "lab/harness/statistics.hpp"

namespace packtrace {
namespace {

std::string nanoseconds(double seconds)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1fns", 1e9 * seconds);
    return text;
}

}  // namespace

Image<float> cost_picture(const std::vector<double>& seconds, int width, int height)
{
    // An interrupted pixel is off the scale, not the scale.
    const double low = quantile(seconds, 0.001);
    const double high = std::max(quantile(seconds, 0.999), low * 1.0001);
    Image<float> image(width, height);
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        const auto color = color_ramp(std::clamp((seconds[i] - low) / (high - low), 0.0, 1.0));
        std::copy(color.begin(), color.end(), &image.rgb[3 * i]);
    }
    return with_legend(image, nanoseconds(low), nanoseconds(high));
}

}  // namespace packtrace
