#pragma once

#include "image/bytes.hpp"
#include <packtrace/image.hpp>

#include <optional>
#include <string>
#include <string_view>

// YUV4MPEG2, the uncompressed video that ffmpeg and mpv read from a pipe: a header, then each
// frame as three planes of 8 bits without subsampling (C444).
namespace packtrace {

/// Frames in so many seconds, without a common divisor: 30000 in 1001 are television's 29.97.
struct FrameRate {
    int frames = 30;
    int seconds = 1;
};

/// Reads "24", "23.976" (2997/125, to the digit) or "30000/1001", of more than 0 to 1000 frames a
/// second; nothing for any other text.
[[nodiscard]] std::optional<FrameRate> parse_frame_rate(std::string_view text);

/// The stream's first line, for square pixels and progressive frames.
[[nodiscard]] std::string y4m_header(int width, int height, const FrameRate& rate);

/// One frame. The picture is quantised as for PNG, then taken to BT.601's limited range (black is
/// Y 16, white 235) in whole numbers, so that the bytes are the same everywhere:
///     Y = ( 66 R + 129 G +  25 B + 128) / 256 +  16
///     U = (-38 R -  74 G + 112 B + 128) / 256 + 128
///     V = (112 R -  94 G -  18 B + 128) / 256 + 128    each division rounding down
template <class Real>
[[nodiscard]] Bytes y4m_frame(const Image<Real>& image, double gamma = 1.0);

}  // namespace packtrace
