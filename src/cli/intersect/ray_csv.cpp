#include "cli/intersect/ray_csv.hpp"

#include "core/read_file.hpp"
#include "core/text.hpp"
#include "scene/language/quote.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

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

/// Removes the next field from `rest` and returns it without the blanks around it.
std::string_view cut_field(std::string_view& rest)
{
    const std::size_t end = rest.find(',');
    const std::string_view field = trimmed(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    return field;
}

bool is_header(std::string_view text, std::size_t columns)
{
    for (std::size_t i = 0; i < columns; ++i)
        if (cut_field(text) != ray_columns[i])
            return false;
    return true;
}

/// Throws FileError, `file:line:column: message`. `at` points into the line.
[[noreturn]] void fail_at(const RayFormat& format, const CsvLine& line, const char* at,
                          const std::string& message)
{
    throw FileError(format.file + ':' + std::to_string(line.number) + ':' +
                    std::to_string(at - line.text.data() + 1) + ": " + message);
}

constexpr std::size_t dx = 3;
constexpr std::size_t t_min = 6;
constexpr std::size_t t_max = 7;

using Fields = std::array<std::string_view, most_ray_columns>;

/// The number of a CSV field in the precision of Real. `error` is std::errc{} for a number,
/// including infinities and NaN, result_out_of_range for a number that is too large, and
/// invalid_argument for other text. A number that is too small becomes zero; below the range of
/// long double it is an error, too.
template <class Real>
struct RayNumber {
    Real value = 0;
    std::errc error{};
};

template <class Real>
RayNumber<Real> parse(std::string_view text)
{
    RayNumber<Real> number;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number.value);
    number.error = stop == end ? error : std::errc::invalid_argument;
    return number;
}

// from_chars does not distinguish too small from too large, but parsing in a wider type does.
template <class Real>
RayNumber<Real> parse_extreme(std::string_view text)
{
    const RayNumber<long double> wide = parse<long double>(text);
    const bool large = std::abs(wide.value) > std::numeric_limits<Real>::max();
    if (wide.error != std::errc{} || large)
        return {Real{}, std::errc::result_out_of_range};
    return {static_cast<Real>(wide.value), std::errc{}};
}

template <class Real>
RayNumber<Real> to_ray_number(std::string_view field)
{
    // from_chars does not accept a plus sign, but the scene language does.
    if (field.starts_with('+') && !field.starts_with("+-"))
        field.remove_prefix(1);
    const RayNumber<Real> number = parse<Real>(field);
    return number.error == std::errc::result_out_of_range ? parse_extreme<Real>(field) : number;
}

/// Reads rays from lines of one format.
template <class Real>
class RowReader {
public:
    explicit RowReader(const RayFormat& format) : format_(format)
    {
    }

    void read(const CsvLine& line, RayColumns<Real>& rays) const
    {
        const Fields fields = split(line);
        std::array<Real, most_ray_columns> row{};
        row[t_max] = infinity;
        for (std::size_t column = 0; column < format_.columns; ++column)
            if (column < t_min || !fields[column].empty())
                row[column] = number(line, column, fields[column]);
        check_direction(line, fields[dx].data(), row);
        rays.add(row);
    }

private:
    static constexpr Real infinity = std::numeric_limits<Real>::infinity();
    static constexpr bool is_single = std::numeric_limits<Real>::digits == 24;
    static constexpr const char* precision = is_single ? "single" : "double";
    static constexpr Real shortest = is_single ? Real(1e-12) : Real(1e-100);
    static constexpr Real longest = is_single ? Real(1e12) : Real(1e100);
    static constexpr double furthest = 1e150;
    static constexpr const char* limits = is_single ? "1e-12 and 1e12" : "1e-100 and 1e100";

    // Kernels square directions. Far from 1 this overflows or underflows, and hits would be wrong
    // or missing.
    void check_direction(const CsvLine& line, const char* at,
                         const std::array<Real, most_ray_columns>& row) const
    {
        const Real largest =
            std::max({std::abs(row[dx]), std::abs(row[dx + 1]), std::abs(row[dx + 2])});
        if (largest == 0)
            fail_at(
                format_, line, at,
                "the direction is zero and leads nowhere; make one of dx, dy, dz differ from 0");
        if (largest < shortest || largest > longest)
            fail_at(format_, line, at,
                    std::string("the direction is too ") + (largest > 1 ? "long" : "short") +
                        " for " + precision +
                        " precision; scale it so that its largest component "
                        "lies between " +
                        limits);
    }

    [[nodiscard]] Fields split(const CsvLine& line) const
    {
        const auto commas = std::count(line.text.begin(), line.text.end(), ',');
        if (static_cast<std::size_t>(commas) + 1 != format_.columns)
            fail_count(line, static_cast<std::size_t>(commas) + 1);
        Fields fields;
        std::string_view rest = line.text;
        for (std::size_t column = 0; column < format_.columns; ++column)
            fields[column] = cut_field(rest);
        return fields;
    }

    [[noreturn]] void fail_count(const CsvLine& line, std::size_t count) const
    {
        // Report the first surplus field, or the place of the missing one.
        std::string_view rest = line.text;
        for (std::size_t column = 0; column < std::min(count, format_.columns); ++column)
            static_cast<void>(cut_field(rest));
        const std::string wanted = std::to_string(format_.columns);
        fail_at(format_, line, rest.data(),
                counted(static_cast<std::int64_t>(count), "column") + " where line " +
                    std::to_string(format_.first_line) + " has " + wanted + "; write " + wanted +
                    " on every line");
    }

    [[nodiscard]] Real number(const CsvLine& line, std::size_t column, std::string_view field) const
    {
        const RayNumber<Real> number = to_ray_number<Real>(field);
        if (number.error == std::errc::invalid_argument)
            fail_no_number(line, column, field);
        if (number.error != std::errc{})
            fail(line, column, field,
                 std::string("is out of the range of ") + precision + " precision");
        if (column == t_max ? std::isnan(number.value) : !std::isfinite(number.value))
            fail(line, column, field,
                 column == t_max
                     ? "is not a number; write a number, or inf for a ray without an end"
                     : "is not finite; write a finite number");
        if (column < dx && std::abs(static_cast<double>(number.value)) > furthest)
            fail(line, column, field,
                 "is further than squares of doubles reach; stay within 1e150");
        if (column == t_min && number.value < 0)
            fail(line, column, field, "is below 0; a ray starts at t_min >= 0");
        return number.value;
    }

    [[noreturn]] void fail_no_number(const CsvLine& line, std::size_t column,
                                     std::string_view field) const
    {
        if (line.number == format_.first_line)
            fail(line, column, field,
                 "is no number; write one such as 0.5, or as a header line "
                 "ox,oy,oz,dx,dy,dz or ox,oy,oz,dx,dy,dz,t_min,t_max");
        fail(line, column, field, "is no number; write one such as 0.5");
    }

    [[noreturn]] void fail(const CsvLine& line, std::size_t column, std::string_view field,
                           const std::string& why) const
    {
        fail_at(format_, line, field.data(),
                std::string(ray_columns[column]) + ' ' + language::quote(field) + ' ' + why);
    }

    const RayFormat& format_;
};

}  // namespace

void learn(RayFormat& format, const CsvLine& first)
{
    const auto commas = std::count(first.text.begin(), first.text.end(), ',');
    const auto columns = static_cast<std::size_t>(commas) + 1;
    if (columns != 6 && columns != most_ray_columns)
        fail_at(
            format, first, first.text.data(),
            counted(commas + 1, "column") +
                " can't be a ray; write 6, ox,oy,oz,dx,dy,dz, or 8 with t_min,t_max after them");
    format.columns = columns;
    format.first_line = first.number;
    format.header_line = is_header(first.text, columns) ? first.number : 0;
}

template <class Real>
void read_rays(const RayFormat& format, std::string_view text, std::size_t first_line,
               RayColumns<Real>& rays)
{
    for (std::vector<Real>& column : rays.columns)
        column.clear();
    const RowReader<Real> row(format);
    CsvLines lines(text, first_line);
    while (const std::optional<CsvLine> line = lines.next())
        if (line->number != format.header_line)
            row.read(*line, rays);
}

template void read_rays(const RayFormat&, std::string_view, std::size_t, RayColumns<float>&);
template void read_rays(const RayFormat&, std::string_view, std::size_t, RayColumns<double>&);

}  // namespace packtrace::cli
