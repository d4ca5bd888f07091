#include "image/recipe.hpp"

#include <libdeflate.h>

#include <array>
#include <fstream>

#include <packtrace/image_io.hpp>

#include "core/atomic_file.hpp"
#include "core/read_file.hpp"
#include "image/format.hpp"
#include "image/png.hpp"

namespace packtrace {
namespace {

std::filesystem::path beside(std::filesystem::path picture)
{
    picture += ".recipe";
    return picture;
}

/// Tells a picture from one that has since been put into its place.
std::string mark_of(const void* bytes, std::size_t size)
{
    return std::to_string(size) + " bytes, checksum " +
           std::to_string(libdeflate_crc32(0, bytes, size));
}

std::string recipe_in_png(const std::filesystem::path& picture)
{
    std::array<char, longest_recipe + 100> head{};
    std::ifstream in(picture, std::ios::binary);
    in.read(head.data(), head.size());
    return png_recipe({reinterpret_cast<const std::uint8_t*>(head.data()),
                       static_cast<std::size_t>(in.gcount())});
}

}  // namespace

void write_recipe_beside(const std::filesystem::path& picture, std::span<const std::uint8_t> bytes,
                         const std::string& recipe)
{
    AtomicFile output(beside(picture));
    output.write(recipe + "\n" + mark_of(bytes.data(), bytes.size()) + "\n");
    output.commit();
}

std::string read_recipe_beside(const std::filesystem::path& picture)
{
    try {
        const std::string text = read_file(beside(picture));
        const std::string bytes = read_file(picture);
        const std::string mark = "\n" + mark_of(bytes.data(), bytes.size()) + "\n";
        if (text.ends_with(mark))
            return text.substr(0, text.size() - mark.size());
    } catch (const FileError&) {
        // Not there, or not to be read: nobody knows what made the picture.
    }
    return {};
}

std::string read_recipe(const std::filesystem::path& file)
{
    return image_format(file) == ImageFormat::png ? recipe_in_png(file) : read_recipe_beside(file);
}

}  // namespace packtrace
