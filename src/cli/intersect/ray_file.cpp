#include "cli/intersect/ray_file.hpp"

#include "core/checksum.hpp"
#include "core/read_file.hpp"
#include "scene/language/quote.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <sys/types.h>
#include <utility>

namespace packtrace::cli {
namespace {

// Spreadsheets put it before a text in UTF-8.
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// The start of the first line that begins at or after `place`.
std::uint64_t next_line(const std::string& file, std::uint64_t place)
{
    const std::uint64_t size = ray_file_size(file);
    if (place == 0 || place >= size)
        return place == 0 ? 0 : size;
    const OpenFile input(std::fopen(file.c_str(), "rb"));
    if (!input || fseeko(input.get(), static_cast<off_t>(place - 1), SEEK_SET) != 0)
        throw FileError(language::escape(file), FileAction::read, errno);
    for (int c; place <= size; ++place)
        if (c = std::fgetc(input.get()); c == '\n' || c == EOF)
            return c == EOF ? size : place;
    return size;
}

}  // namespace

TextBlocks::TextBlocks(const std::string& file, std::uint64_t begin, std::uint64_t end)
    : name_(file == "-" ? "standard input" : language::escape(file)),
      file_(file == "-" ? stdin : std::fopen(file.c_str(), "rb")),
      left_(end - begin)
{
    if (!file_ || (begin > 0 && fseeko(file_.get(), static_cast<off_t>(begin), SEEK_SET) != 0))
        throw FileError(name_, FileAction::read, errno);
}

std::string TextBlocks::next()
{
    std::string block = std::exchange(begun_, {});
    const std::size_t kept = block.size();
    block.resize(largest);
    const std::size_t wanted = std::min<std::uint64_t>(largest - kept, left_);
    const std::size_t got = std::fread(block.data() + kept, 1, wanted, file_.get());
    left_ -= got;
    block.resize(kept + got);
    if (std::ferror(file_.get()))
        throw FileError(name_, FileAction::read, errno);
    if (block.size() < largest)
        return block;

    const std::size_t end = block.rfind('\n');
    if (end == std::string::npos)
        throw FileError(name_ + ':' + std::to_string(lines_ + 1) + ":1: a line of " +
                        std::to_string(largest) +
                        " bytes or more can't be a ray; write one ray a line");
    begun_ = block.substr(end + 1);
    block.resize(end + 1);
    lines_ += static_cast<std::size_t>(std::count(block.begin(), block.end(), '\n'));
    return block;
}

RayBlocks::RayBlocks(const std::string& file, const RayRange& range)
    : blocks_(file, range.begin, range.end),
      format_(range.format),
      line_(range.first_line),
      ray_(range.first_ray)
{
    format_.file = blocks_.name();
}

RayBlock RayBlocks::next()
{
    RayBlock block;
    block.text = blocks_.next();
    if (line_ == 1 && block.text.starts_with(byte_order_mark))
        block.text.replace(0, byte_order_mark.size(), byte_order_mark.size(), ' ');
    block.first_line = line_;
    block.first_ray = ray_;
    CsvLines lines(block.text, line_);
    while (const std::optional<CsvLine> line = lines.next()) {
        if (format_.columns == 0)
            learn(format_, *line);
        if (line->number != format_.header_line)
            ++ray_;
    }
    line_ = lines.number();
    block.rays = ray_ - block.first_ray;
    block.format = format_;
    return block;
}

std::uint32_t ray_file_checksum(const std::string& file)
{
    constexpr std::uint64_t piece = std::uint64_t{1} << 16u;
    constexpr std::uint64_t pieces = 1024;
    const std::uint64_t size = ray_file_size(file);
    std::ifstream input(file, std::ios::binary);
    std::vector<char> bytes(piece);
    std::uint32_t sum = 0;
    const std::uint64_t count = std::min(pieces, (size + piece - 1) / piece);
    for (std::uint64_t i = 0; i < count; ++i) {
        const bool whole = size <= piece * pieces;
        const std::uint64_t place = whole ? i * piece : (size - piece) / (pieces - 1) * i;
        input.seekg(static_cast<std::streamoff>(place));
        input.read(bytes.data(), static_cast<std::streamsize>(std::min(piece, size - place)));
        if (!input)
            throw FileError(language::escape(file), FileAction::read, errno);
        const auto length = static_cast<std::size_t>(input.gcount());
        sum = checksum(bytes_of(std::string_view(bytes.data(), length)), sum);
    }
    return sum;
}

std::uint64_t ray_file_size(const std::string& file)
{
    if (file == "-")
        throw FileError("standard input can't be cut into parts; write the rays into a file");
    std::error_code error;
    const bool regular = std::filesystem::is_regular_file(file, error);
    if (!regular && error)
        throw FileError(language::escape(file), FileAction::read, error.value());
    if (!regular)
        throw FileError(language::escape(file) +
                        ": only a regular file can be cut into parts; write the rays into one");
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error)
        throw FileError(language::escape(file), FileAction::read, error.value());
    return size;
}

RayRange cut_rays(const std::string& file, std::uint64_t index, std::uint64_t count)
{
    const std::uint64_t size = ray_file_size(file);
    // Computed in two steps, because size * i could exceed 64 bits.
    const auto place = [&](std::uint64_t i) { return size / count * i + size % count * i / count; };
    return {.begin = next_line(file, place(index)), .end = next_line(file, place(index + 1))};
}

RayRange numbered_rays(const std::string& file, std::uint64_t index, std::uint64_t count)
{
    RayRange range = cut_rays(file, index, count);
    if (range.begin == 0)
        return range;
    RayRange before{.end = range.begin};
    const RayCount counted = count_rays(file, before);
    range.first_line += counted.lines;
    range.first_ray = counted.rays;
    range.format = format_of_rays(file);
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
