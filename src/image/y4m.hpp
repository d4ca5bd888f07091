#pragma once

#include <string>

#include <packtrace/image.hpp>

#include "image/bytes.hpp"

// YUV4MPEG2, the uncompressed video that ffmpeg and mpv read from a pipe: a header, then each
// frame as three planes of 8 bits without subsampling (C444).
namespace packtrace {

/// The stream's first line, for square pixels and progressive frames.
[[nodiscard]] std::string y4m_header(int width, int height, int frames_per_second);

/// One frame. The picture is quantised as for PNG, then taken to BT.601's limited range (black is
/// Y 16, white 235) in whole numbers, so that the bytes are the same everywhere:
///     Y = ( 66 R + 129 G +  25 B + 128) / 256 +  16
///     U = (-38 R -  74 G + 112 B + 128) / 256 + 128
///     V = (112 R -  94 G -  18 B + 128) / 256 + 128    each division rounding down
template <class Real>
[[nodiscard]] Bytes y4m_frame(const Image<Real>& image, double gamma = 1.0);

}  // namespace packtrace
