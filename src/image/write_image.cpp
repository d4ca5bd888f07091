#include <packtrace/image_io.hpp>

#include "core/atomic_file.hpp"
#include "image/format.hpp"
#include "image/hdr.hpp"
#include "image/pfm.hpp"
#include "image/png.hpp"

namespace packtrace {
namespace {

Bytes encode(ImageFormat format, const Image<float>& image, const ImageWriteOptions& options)
{
    switch (format) {
        case ImageFormat::png:
            return encode_png(image, {.gamma = options.gamma});
        case ImageFormat::pfm:
            return encode_pfm(image);
        case ImageFormat::hdr:
            break;
    }
    return encode_hdr(image);
}

}  // namespace

void write_image(const std::filesystem::path& file, const Image<float>& image,
                 const ImageWriteOptions& options)
{
    const ImageFormat format = image_format(file);
    if (image.width < 1 || image.height < 1)
        throw ImageError(file.string() + ": can't write a picture without pixels");
    try {
        AtomicFile output(file);
        const Bytes bytes = encode(format, image, options);
        output.write(std::as_bytes(std::span(bytes)));
        output.commit();
    } catch (const FileError& error) {
        throw ImageError(error.what());
    } catch (const ImageError& error) {
        throw ImageError(file.string() + ": " + error.what());
    }
}

void check_image_writable(const std::filesystem::path& file)
{
    static_cast<void>(image_format(file));
    try {
        check_writable(file);
    } catch (const FileError& error) {
        throw ImageError(error.what());
    }
}

}  // namespace packtrace
