#include "cli/intersect/ray_format.hpp"

#include <algorithm>

#include "core/file_error.hpp"

namespace packtrace::cli {
namespace {

std::string_view trimmed(std::string_view text)
{
    const auto blank = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && blank(text.back()))
        text.remove_suffix(1);
    return text;
}

bool is_header(std::string_view text, std::size_t columns)
{
    for (std::size_t i = 0; i < columns; ++i)
        if (cut_field(text) != ray_columns[i])
            return false;
    return true;
}

}  // namespace

std::string_view cut_field(std::string_view& rest)
{
    const std::size_t end = rest.find(',');
    const std::string_view field = trimmed(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    return field;
}

void learn(RayFormat& format, const CsvLine& first)
{
    const auto commas = std::count(first.text.begin(), first.text.end(), ',');
    const auto columns = static_cast<std::size_t>(commas) + 1;
    if (columns != 6 && columns != most_ray_columns)
        fail_at(
            format, first, first.text.data(),
            std::to_string(columns) + (columns == 1 ? " column" : " columns") +
                " can't be a ray; write 6, ox,oy,oz,dx,dy,dz, or 8 with t_min,t_max after them");
    format.columns = columns;
    format.first_line = first.number;
    format.header_line = is_header(first.text, columns) ? first.number : 0;
}

void fail_at(const RayFormat& format, const CsvLine& line, const char* at,
             const std::string& message)
{
    throw FileError(format.file + ':' + std::to_string(line.number) + ':' +
                    std::to_string(at - line.text.data() + 1) + ": " + message);
}

}  // namespace packtrace::cli
