// Any bytes as PNG, PFM and Radiance HDR give an error, or a picture with as many values as its
// size says.
#include "fuzzer.hpp"
#include "image/formats.hpp"
#include <packtrace/image_io.hpp>

namespace {

template <class Decode>
void decode_any(const Decode& decode, packtrace::fuzz::Bytes bytes)
{
    try {
        const packtrace::Image<float> image = decode(bytes);
        const auto pixels =
            static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
        packtrace::fuzz::require(image.width > 0 && image.height > 0, "a picture has pixels");
        packtrace::fuzz::require(image.rgb.size() == 3 * pixels, "a picture has all its values");
    } catch (const packtrace::ImageError&) {
    }
}

}  // namespace

PACKTRACE_FUZZER(pictures)
{
    decode_any(packtrace::decode_png, bytes);
    decode_any(packtrace::decode_pfm, bytes);
    decode_any(packtrace::decode_hdr, bytes);
}
