#include "image/color_ramp.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace packtrace {
namespace {

constexpr int bar_height = 8;
constexpr int legend_height = bar_height + 12;
constexpr int digit_width = 3;
constexpr int digit_height = 5;

// The glyphs of these characters: rows of three pixels from the top, one bit per pixel.
constexpr std::string_view legend_characters = "0123456789.nse+-";
constexpr std::array<std::array<unsigned char, digit_height>, 16> legend_glyphs{{
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
    {2, 5, 7, 4, 3},
    {0, 2, 7, 2, 0},
    {0, 0, 7, 0, 0},
}};
static_assert(legend_glyphs.size() == legend_characters.size());

void set_pixel(Image<float>& image, int x, int y, const std::array<float, 3>& color)
{
    if (x >= 0 && x < image.width && y >= 0 && y < image.height)
        std::copy(color.begin(), color.end(), image.pixel(x, y));
}

void draw_text(Image<float>& image, int x, int y, const std::string& text)
{
    for (const char c : text) {
        const std::size_t number = legend_characters.find(c);
        for (int row = 0; number != std::string_view::npos && row < digit_height; ++row)
            for (int column = 0; column < digit_width; ++column)
                if (legend_glyphs[number][static_cast<std::size_t>(row)] >>
                        (digit_width - 1 - column) &
                    1)
                    set_pixel(image, x + column, y + row, {1, 1, 1});
        x += digit_width + 1;
    }
}

int text_width(const std::string& text)
{
    return static_cast<int>(text.size()) * (digit_width + 1);
}

}  // namespace

Image<float> with_legend(const Image<float>& picture, const std::string& low,
                         const std::string& high)
{
    Image<float> image(picture.width, picture.height + legend_height);
    std::copy(picture.rgb.begin(), picture.rgb.end(), image.rgb.begin());
    const int top = picture.height + 2;
    for (int x = 0; x < image.width; ++x)
        for (int y = 0; y < bar_height; ++y)
            set_pixel(image, x, top + y, color_ramp(x / std::max(1.0, image.width - 1.0)));
    const int below = top + bar_height + 2;
    draw_text(image, 1, below, low);
    draw_text(image, image.width - text_width(high), below, high);
    return image;
}

}  // namespace packtrace
