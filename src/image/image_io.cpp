// Writes, checks and reads picture files in the format of their extension, and their recipes.
// Formats without room for text have the recipe in a second file.
#include "core/atomic_file.hpp"
#include "core/checksum.hpp"
#include "core/read_file.hpp"
#include "image/formats.hpp"
#include <packtrace/image_io.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace packtrace {
namespace {

constexpr std::size_t longest_recipe = 2000;

std::filesystem::path beside(std::filesystem::path picture)
{
    picture += ".recipe";
    return picture;
}

/// Identifies the bytes of a picture, to detect that the file was replaced.
std::string mark_of(std::span<const std::uint8_t> bytes)
{
    return std::to_string(bytes.size()) + " bytes, checksum " + std::to_string(checksum(bytes));
}

std::string recipe_in_png(const std::filesystem::path& picture)
{
    try {
        return png_recipe(bytes_of(read_file(picture)));
    } catch (const FileError&) {
        // The file does not exist or cannot be read.
        return {};
    }
}

/// Writes the recipe file beside `picture`, whose content is `bytes`. Throws FileError.
void write_recipe_beside(const std::filesystem::path& picture, std::span<const std::uint8_t> bytes,
                         const std::string& recipe)
{
    write_file(beside(picture), recipe + "\n" + mark_of(bytes) + "\n");
}

/// The recipe beside `picture`; empty if there is none, or if the picture has other bytes now.
std::string read_recipe_beside(const std::filesystem::path& picture)
{
    try {
        const std::string text = read_file(beside(picture));
        const std::string bytes = read_file(picture);
        const std::string mark = "\n" + mark_of(bytes_of(bytes)) + "\n";
        if (text.ends_with(mark))
            return text.substr(0, text.size() - mark.size());
    } catch (const FileError&) {
        // There is no picture or no recipe, or it cannot be read.
    }
    return {};
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
    if constexpr (std::is_same_v<Real, float>)
        return encode_hdr(image);
    else
        return encode_hdr(convert<float>(image));
}

/// Throws std::invalid_argument for a gamma that the format does not support. The encoder of PNG
/// checks its own range.
void check_gamma(ImageFormat format, double gamma)
{
    if (format != ImageFormat::png && gamma != 1.0)
        throw std::invalid_argument(
            "gamma: only PNG has one; .pfm and .hdr hold linear values; leave it out or write "
            ".png");
}

void check_recipe(const std::string& recipe)
{
    const auto printable = [](char letter) { return letter >= ' ' && letter <= '~'; };
    if (recipe.size() > longest_recipe || !std::all_of(recipe.begin(), recipe.end(), printable))
        throw std::invalid_argument("a recipe is a line of at most " +
                                    std::to_string(longest_recipe) + " printable ASCII characters");
}

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

std::optional<ImageFormat> find_image_format(const std::filesystem::path& file)
{
    const std::string extension = file.extension().string();
    std::string lower = extension;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    if (lower == ".png")
        return ImageFormat::png;
    if (lower == ".pfm")
        return ImageFormat::pfm;
    if (lower == ".hdr")
        return ImageFormat::hdr;
    return std::nullopt;
}

ImageFormat image_format(const std::filesystem::path& file)
{
    if (const auto format = find_image_format(file))
        return *format;
    const std::string extension = file.extension().string();
    const std::string what = extension.empty() ? "no extension tells the picture format"
                                               : "unknown picture format '" + extension + "'";
    throw ImageError(file.string() + ": " + what + "; use .png, .pfm or .hdr");
}

template <class Real>
void write_image(const std::filesystem::path& file, const Image<Real>& image,
                 const ImageWriteOptions& options)
{
    const ImageFormat format = image_format(file);
    check_gamma(format, options.gamma);
    check_recipe(options.recipe);
    if (image.width < 1 || image.height < 1)
        throw ImageError(file.string() + ": can't write a picture without pixels");
    image.check();
    named(file, [&] {
        AtomicFile output(file);
        const Bytes bytes = encode(format, image, options);
        output.write(std::as_bytes(std::span(bytes)));
        output.commit();
        if (!options.recipe.empty() && format != ImageFormat::png)
            write_recipe_beside(file, bytes, options.recipe);
    });
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
    named(file, [&] { check_writable(file); });
}

Image<float> read_image(const std::filesystem::path& file)
{
    const ImageFormat format = image_format(file);
    return named(file, [&] {
        const std::string bytes = read_file(file);
        return decode(format, bytes_of(bytes));
    });
}

std::string read_recipe(const std::filesystem::path& file)
{
    return image_format(file) == ImageFormat::png ? recipe_in_png(file) : read_recipe_beside(file);
}

}  // namespace packtrace
