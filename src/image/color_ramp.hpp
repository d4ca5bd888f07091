#pragma once

#include <packtrace/image.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

// The colours of pictures that show numbers, and the legend below such a picture.
namespace packtrace {

/// The colour at `place` in [0, 1] from black through blue, green, yellow and red to white.
[[nodiscard]] inline std::array<float, 3> color_ramp(double place)
{
    using Color = std::array<float, 3>;
    constexpr std::array<Color, 6> stops{Color{0, 0, 0}, Color{0, 0, 1}, Color{0, 1, 0},
                                         Color{1, 1, 0}, Color{1, 0, 0}, Color{1, 1, 1}};
    const double scaled = place * (stops.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(scaled), stops.size() - 2);
    const auto share = static_cast<float>(scaled - static_cast<double>(below));
    Color color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = stops[below][c] + share * (stops[below + 1][c] - stops[below][c]);
    return color;
}

/// The picture over a bar with the colours of color_ramp() from end to end, and below it what
/// the ends stand for. Texts are of digits and the characters of "e.+-ns".
[[nodiscard]] Image<float> with_legend(const Image<float>& picture, const std::string& low,
                                       const std::string& high);

}  // namespace packtrace
