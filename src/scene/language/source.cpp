#include "scene/language/source.hpp"

#include "scene/language/quote.hpp"
#include <packtrace/read_scene.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace packtrace::language {
namespace {

std::string placed(const Source& source, Position at, const std::string& message)
{
    return escape(source.name) + ':' + std::to_string(at.line) + ':' + std::to_string(at.column) +
           ": " + message;
}

[[noreturn]] void fail_file(const std::string& name, const std::string& reason)
{
    throw SceneError(escape(name) + ": " + reason);
}

/// Stops early in a line that is too long, because files that are not text mostly have one.
std::string read_up_to(std::istream& in, std::size_t limit)
{
    constexpr std::size_t step = std::size_t{1} << 16u;
    std::string text;
    std::size_t line = 0;
    while (in && text.size() < limit && text.size() - line <= longest_line) {
        const std::size_t size = text.size();
        text.resize(size + step);
        in.read(text.data() + size, step);
        text.resize(size + static_cast<std::size_t>(in.gcount()));
        const std::size_t last = std::string_view(text).substr(size).rfind('\n');
        if (last != std::string_view::npos)
            line = size + last + 1;
    }
    return text;
}

bool is_text(char c)
{
    const auto byte = static_cast<unsigned char>(c);
    return (byte >= 0x20u && byte != 0x7Fu) || c == '\n' || c == '\r' || c == '\t';
}

void check_line(const Source& source, std::size_t number, std::string_view line)
{
    if (line.size() > longest_line)
        fail(source, Position::of(number, longest_line + 1),
             "the line has more than " + std::to_string(longest_line) +
                 " bytes; break it into several");
    const std::size_t mark = line.find('\r');
    if (mark < line.size() - 1)
        fail(source, Position::of(number, mark + 1),
             "a carriage return that no line feed follows ends no line; end lines with a line "
             "feed, or with both");
    const auto odd = std::find_if_not(line.begin(), line.end(), is_text);
    if (odd != line.end())
        fail(source, Position::of(number, static_cast<std::size_t>(odd - line.begin()) + 1),
             "the byte " + quote(std::string_view(&*odd, 1)) +
                 " does not belong in text; is this a binary file? give a scene file");
}

}  // namespace

void fail(const Source& source, Position at, const std::string& message)
{
    throw SceneError(placed(source, at, message));
}

void warn(const Source& source, Position at, const std::string& message)
{
    if (source.take_warning)
        source.take_warning(placed(source, at, message));
}

std::string load_text(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        fail_file(file.string(), "this is a directory; give a scene file");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in)
        fail_file(file.string(), std::string("can't be opened (") + std::strerror(errno) +
                                     "); check the name and the permissions");
    return load_text(in, file.string());
}

std::string load_text(std::istream& in, const std::string& name)
{
    std::string text = read_up_to(in, longest_file + 1);
    if (in.bad())
        fail_file(name, "can't be read to its end; check the disk and the permissions");
    return text;
}

void check_text(const Source& source)
{
    if (source.text.size() > longest_file)
        fail(source, {},
             "the file has more than " + std::to_string(longest_file >> 30u) +
                 " GiB; give a smaller scene");
    if (source.text.empty())
        fail(source, {},
             "the file is empty; a scene needs an object, e.g. "
             "sphere { center = (0, 0, 3) radius = 1 }");
    std::size_t number = 1;
    for (std::size_t begin = 0; begin < source.text.size(); ++number) {
        const std::size_t end = std::min(source.text.find('\n', begin), source.text.size());
        check_line(source, number, source.text.substr(begin, end - begin));
        begin = end + 1;
    }
}

}  // namespace packtrace::language
