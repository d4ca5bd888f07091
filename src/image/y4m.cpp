#include "image/y4m.hpp"

#include "core/text.hpp"
#include "image/bytes.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

namespace packtrace {
namespace {

/// The factors of a plane for R, G, B, and the offset.
struct ColorPlane {
    int r, g, b, offset;
};

constexpr ColorPlane planes[] = {{66, 129, 25, 16}, {-38, -74, 112, 128}, {112, -94, -18, 128}};
constexpr std::string_view frame_line = "FRAME\n";

std::uint8_t sample(const ColorPlane& plane, const std::uint8_t* rgb)
{
    const int sum = plane.r * rgb[0] + plane.g * rgb[1] + plane.b * rgb[2] + 128;
    return static_cast<std::uint8_t>((sum >> 8) + plane.offset);
}

/// Reads a text that has only digits, few enough for the computations with the number.
std::optional<std::int64_t> digits(std::string_view text)
{
    constexpr std::size_t most = 9;
    if (text.empty() || text.size() > most || text.front() == '-')
        return std::nullopt;
    return parse_number<std::int64_t>(text);
}

/// The rate in lowest terms.
std::optional<FrameRate> rate_of(std::int64_t frames, std::int64_t seconds)
{
    constexpr std::int64_t most_a_second = 1000;
    if (frames <= 0 || seconds <= 0 || frames > most_a_second * seconds)
        return std::nullopt;
    const std::int64_t common = std::gcd(frames, seconds);
    frames /= common;
    seconds /= common;
    // Players read both numbers as 32 bits.
    if (frames > std::numeric_limits<std::int32_t>::max())
        return std::nullopt;
    return FrameRate{static_cast<int>(frames), static_cast<int>(seconds)};
}

}  // namespace

std::optional<FrameRate> parse_frame_rate(std::string_view text)
{
    const std::size_t mark = text.find_first_of("./");
    const auto before = digits(text.substr(0, mark));
    if (mark == std::string_view::npos)
        return before ? rate_of(*before, 1) : std::nullopt;
    const std::string_view rest = text.substr(mark + 1);
    const auto behind = digits(rest);
    if (!before || !behind)
        return std::nullopt;
    if (text[mark] == '/')
        return rate_of(*before, *behind);
    std::int64_t scale = 1;
    for (std::size_t i = 0; i < rest.size(); ++i)
        scale *= 10;
    return rate_of(*before * scale + *behind, scale);
}

std::string y4m_header(int width, int height, const FrameRate& rate)
{
    return "YUV4MPEG2 W" + std::to_string(width) + " H" + std::to_string(height) + " F" +
           std::to_string(rate.frames) + ":" + std::to_string(rate.seconds) +
           " Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
}

template <class Real>
Bytes y4m_frame(const Image<Real>& image, double gamma)
{
    Bytes rgb(image.rgb.size());
    quantise<Real>(image.rgb, gamma, rgb.data());
    Bytes frame(frame_line.size() + rgb.size());
    auto to = std::copy(frame_line.begin(), frame_line.end(), frame.begin());
    for (const ColorPlane& plane : planes)
        for (std::size_t i = 0; i < rgb.size(); i += 3)
            *to++ = sample(plane, rgb.data() + i);
    return frame;
}

template Bytes y4m_frame(const Image<float>&, double);
template Bytes y4m_frame(const Image<double>&, double);
template Bytes y4m_frame(const Image<long double>&, double);

}  // namespace packtrace
