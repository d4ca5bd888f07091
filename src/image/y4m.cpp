#include "image/y4m.hpp"

#include "image/bytes.hpp"

#include <algorithm>
#include <string_view>

namespace packtrace {
namespace {

/// A plane's factors for R, G, B and what is added in the end.
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

}  // namespace

std::string y4m_header(int width, int height, int frames_per_second)
{
    return "YUV4MPEG2 W" + std::to_string(width) + " H" + std::to_string(height) + " F" +
           std::to_string(frames_per_second) + ":1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
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
