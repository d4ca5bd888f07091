#include <span>

#include <packtrace/image_io.hpp>

#include "core/read_file.hpp"
#include "image/format.hpp"
#include "image/hdr.hpp"
#include "image/pfm.hpp"
#include "image/png.hpp"

namespace packtrace {
namespace {

Image<float> decode(ImageFormat format, std::span<const std::uint8_t> bytes)
{
    switch (format) {
        case ImageFormat::png:
            return decode_png(bytes);
        case ImageFormat::pfm:
            return decode_pfm(bytes);
        case ImageFormat::hdr:
            break;
    }
    return decode_hdr(bytes);
}

}  // namespace

Image<float> read_image(const std::filesystem::path& file)
{
    const ImageFormat format = image_format(file);
    try {
        const std::string bytes = read_file(file);
        return decode(format, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    } catch (const FileError& error) {
        throw ImageError(error.what());
    } catch (const ImageError& error) {
        throw ImageError(file.string() + ": " + error.what());
    }
}

}  // namespace packtrace
