#include "scene/check_text.hpp"

#include "scene/quote.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace packtrace::reader {
namespace {

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
    const auto odd = std::find_if_not(line.begin(), line.end(), is_text);
    if (odd != line.end())
        fail(source, Position::of(number, static_cast<std::size_t>(odd - line.begin()) + 1),
             "the byte " + quote(std::string_view(&*odd, 1)) +
                 " does not belong in text; is this a binary file? give a scene file");
}

}  // namespace

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

}  // namespace packtrace::reader
