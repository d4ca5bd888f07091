#pragma once

#include <packtrace/image.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

// The colours and the legend of pictures that show numbers.
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

/// Adds a bar with the colours of color_ramp() below the picture, and the texts for its ends. Texts
/// may have digits and the characters "e.+-ns".
[[nodiscard]] Image<float> with_legend(const Image<float>& picture, const std::string& low,
                                       const std::string& high);

}  // namespace packtrace
