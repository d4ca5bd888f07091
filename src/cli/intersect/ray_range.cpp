#include "cli/intersect/ray_range.hpp"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <sys/types.h>

#include "cli/intersect/ray_blocks.hpp"
#include "core/file_error.hpp"
#include "scene/quote.hpp"

namespace packtrace::cli {

std::uint64_t ray_file_size(const std::string& file)
{
    std::error_code error;
    const bool regular = std::filesystem::is_regular_file(file, error);
    if (!regular && (error || file == "-"))
        throw FileError(language::escape(file) + ": can't read: No such file or directory");
    if (!regular)
        throw FileError(language::escape(file) +
                        ": only a regular file can be cut into parts; write the rays into one");
    return std::filesystem::file_size(file);
}

std::uint64_t next_line(const std::string& file, std::uint64_t place)
{
    const std::uint64_t size = ray_file_size(file);
    if (place == 0 || place >= size)
        return place == 0 ? 0 : size;
    const auto close = [](std::FILE* opened) { std::fclose(opened); };
    const std::unique_ptr<std::FILE, decltype(close)> input(std::fopen(file.c_str(), "rb"), close);
    if (!input || fseeko(input.get(), static_cast<off_t>(place - 1), SEEK_SET) != 0)
        throw FileError(language::escape(file), "can't read", errno);
    for (int c; place <= size; ++place)
        if (c = std::fgetc(input.get()); c == '\n' || c == EOF)
            return c == EOF ? size : place;
    return size;
}

RayRange cut_rays(const std::string& file, std::uint64_t index, std::uint64_t count)
{
    const std::uint64_t size = ray_file_size(file);
    // In two steps: a product could exceed 64 bits.
    const auto place = [&](std::uint64_t i) { return size / count * i + size % count * i / count; };
    RayRange range;
    range.begin = next_line(file, place(index));
    range.end = next_line(file, place(index + 1));
    return range;
}

RayFormat format_of_rays(const std::string& file)
{
    RayBlocks blocks(file);
    for (RayBlock block = blocks.next(); !block.text.empty(); block = blocks.next())
        if (block.format.columns != 0)
            return block.format;
    return {};
}

RayCount count_rays(const std::string& file, const RayRange& range)
{
    RayBlocks blocks(file, range);
    RayBlock block = blocks.next();
    while (!block.text.empty())
        block = blocks.next();
    return {block.first_line - range.first_line, block.first_ray - range.first_ray};
}

}  // namespace packtrace::cli
