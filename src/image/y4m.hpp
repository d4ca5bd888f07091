#pragma once

#include "image/bytes.hpp"
#include <packtrace/image.hpp>

#include <optional>
#include <string>
#include <string_view>

// YUV4MPEG2, the uncompressed video format that ffmpeg and mpv read from a pipe: a header, then
// each frame as three 8-bit planes without subsampling (C444).
namespace packtrace {

/// frames / seconds, in lowest terms. 30000 / 1001 is the 29.97 of television.
struct FrameRate {
    int frames = 30;
    int seconds = 1;
};

/// Reads a rate above 0, up to 1000 frames per second: "24", "23.976" (exactly 2997/125) or
/// "30000/1001". Not set for other text.
[[nodiscard]] std::optional<FrameRate> parse_frame_rate(std::string_view text);

/// The stream's first line, for square pixels and progressive frames.
[[nodiscard]] std::string y4m_header(int width, int height, const FrameRate& rate);

/// One frame. The picture is quantised as for PNG, then converted to the limited range of BT.601
/// (black is Y 16, white 235). It uses integers, so that the bytes are the same on every machine:
///     Y = ( 66 R + 129 G +  25 B + 128) / 256 +  16
///     U = (-38 R -  74 G + 112 B + 128) / 256 + 128
///     V = (112 R -  94 G -  18 B + 128) / 256 + 128    each division rounding down
template <class Real>
[[nodiscard]] Bytes y4m_frame(const Image<Real>& image, double gamma = 1.0);

}  // namespace packtrace
