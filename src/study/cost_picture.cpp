#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <string_view>

#include <packtrace/profile.hpp>

#include "image/color_ramp.hpp"
#include "study/statistics.hpp"

namespace packtrace {
namespace {

constexpr int bar_height = 8;
constexpr int legend_height = bar_height + 12;
constexpr int digit_width = 3;
constexpr int digit_height = 5;

// Rows of three pixels from the top, a bit each, for the characters below.
constexpr std::string_view characters = "0123456789.ns";
constexpr std::array<std::array<unsigned char, digit_height>, 13> glyphs{{
    {7, 5, 5, 5, 7},
    {2, 6, 2, 2, 7},
    {7, 1, 7, 4, 7},
    {7, 1, 7, 1, 7},
    {5, 5, 7, 1, 1},
    {7, 4, 7, 1, 7},
    {7, 4, 7, 5, 7},
    {7, 1, 2, 2, 2},
    {7, 5, 7, 5, 7},
    {7, 5, 7, 1, 7},
    {0, 0, 0, 0, 2},
    {0, 6, 5, 5, 5},
    {0, 3, 6, 3, 6},
}};

void set_pixel(Image<float>& image, int x, int y, const std::array<float, 3>& color)
{
    if (x >= 0 && x < image.width && y >= 0 && y < image.height)
        std::copy(color.begin(), color.end(), image.pixel(x, y));
}

void draw_text(Image<float>& image, int x, int y, const std::string& text)
{
    for (const char c : text) {
        const std::size_t number = characters.find(c);
        for (int row = 0; number != std::string_view::npos && row < digit_height; ++row)
            for (int column = 0; column < digit_width; ++column)
                if (glyphs[number][static_cast<std::size_t>(row)] >> (digit_width - 1 - column) & 1)
                    set_pixel(image, x + column, y + row, {1, 1, 1});
        x += digit_width + 1;
    }
}

int text_width(const std::string& text)
{
    return static_cast<int>(text.size()) * (digit_width + 1);
}

std::string nanoseconds(double seconds)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1fns", 1e9 * seconds);
    return text;
}

void draw_legend(Image<float>& image, double low, double high)
{
    const int top = image.height - legend_height + 2;
    for (int x = 0; x < image.width; ++x)
        for (int y = 0; y < bar_height; ++y)
            set_pixel(image, x, top + y, color_ramp(x / std::max(1.0, image.width - 1.0)));
    const int below = top + bar_height + 2;
    const std::string most = nanoseconds(high);
    draw_text(image, 1, below, nanoseconds(low));
    draw_text(image, image.width - text_width(most), below, most);
}

}  // namespace

Image<float> cost_picture(const std::vector<double>& seconds, int width, int height)
{
    // An interrupted pixel is off the scale, not the scale.
    const double low = quantile(seconds, 0.001);
    const double high = std::max(quantile(seconds, 0.999), low * 1.0001);
    Image<float> image(width, height + legend_height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double cost =
                seconds[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(x)];
            set_pixel(image, x, y, color_ramp(std::clamp((cost - low) / (high - low), 0.0, 1.0)));
        }
    draw_legend(image, low, high);
    return image;
}

}  // namespace packtrace
