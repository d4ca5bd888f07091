#include <packtrace/image_io.hpp>

#include <algorithm>

#include "core/atomic_file.hpp"
#include "image/format.hpp"
#include "image/hdr.hpp"
#include "image/pfm.hpp"
#include "image/png.hpp"
#include "image/recipe.hpp"

namespace packtrace {
namespace {

Bytes encode_as_hdr(const Image<float>& image)
{
    return encode_hdr(image);
}
template <class Real>
Bytes encode_as_hdr(const Image<Real>& image)
{
    return encode_hdr(convert<float>(image));
}

template <class Real>
Bytes encode(ImageFormat format, const Image<Real>& image, const ImageWriteOptions& options)
{
    switch (format) {
        case ImageFormat::png:
            return encode_png(image, {.gamma = options.gamma, .recipe = options.recipe});
        case ImageFormat::pfm:
            return encode_pfm(image);
        case ImageFormat::hdr:
            break;
    }
    return encode_as_hdr(image);
}

void check_recipe(const std::string& recipe)
{
    const auto printable = [](char letter) { return letter >= ' ' && letter <= '~'; };
    if (recipe.size() > longest_recipe || !std::all_of(recipe.begin(), recipe.end(), printable))
        throw std::invalid_argument("a recipe is a line of at most " +
                                    std::to_string(longest_recipe) + " printable ASCII characters");
}

}  // namespace

template <class Real>
void write_image(const std::filesystem::path& file, const Image<Real>& image,
                 const ImageWriteOptions& options)
{
    const ImageFormat format = image_format(file);
    check_recipe(options.recipe);
    if (image.width < 1 || image.height < 1)
        throw ImageError(file.string() + ": can't write a picture without pixels");
    try {
        AtomicFile output(file);
        const Bytes bytes = encode(format, image, options);
        output.write(std::as_bytes(std::span(bytes)));
        output.commit();
        if (!options.recipe.empty() && format != ImageFormat::png)
            write_recipe_beside(file, bytes, options.recipe);
    } catch (const FileError& error) {
        throw ImageError(error.what());
    } catch (const ImageError& error) {
        throw ImageError(file.string() + ": " + error.what());
    }
}

template void write_image(const std::filesystem::path&, const Image<float>&,
                          const ImageWriteOptions&);
template void write_image(const std::filesystem::path&, const Image<double>&,
                          const ImageWriteOptions&);
template void write_image(const std::filesystem::path&, const Image<long double>&,
                          const ImageWriteOptions&);

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
