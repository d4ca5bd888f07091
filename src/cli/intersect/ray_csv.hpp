#pragma once

#include "render/ray_columns.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

// Reads rays from the lines of a CSV file. The first line defines the format.
namespace packtrace::cli {

/// A line of a CSV file without its line end.
struct CsvLine {
    std::string_view text;
    std::size_t number = 1;  ///< in the file, from 1
};

/// Iterates over the lines of a text, except blank lines and # comments. Lines end in LF or CR LF;
/// the last line may have no end.
class CsvLines {
public:
    CsvLines(std::string_view text, std::size_t first_line) : rest_(text), number_(first_line)
    {
    }

    [[nodiscard]] std::optional<CsvLine> next()
    {
        while (!rest_.empty()) {
            const CsvLine line = cut_line();
            const std::size_t first = line.text.find_first_not_of(" \t");
            if (first != std::string_view::npos && line.text[first] != '#')
                return line;
        }
        return std::nullopt;
    }

    /// The number of the next line.
    [[nodiscard]] std::size_t number() const
    {
        return number_;
    }

private:
    CsvLine cut_line()
    {
        const std::size_t end = rest_.find('\n');
        std::string_view text = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        if (text.ends_with('\r'))
            text.remove_suffix(1);
        return {text, number_++};
    }

    std::string_view rest_;
    std::size_t number_;
};

inline constexpr std::size_t most_ray_columns = 8;
inline constexpr std::array<std::string_view, most_ray_columns> ray_columns{
    "ox", "oy", "oz", "dx", "dy", "dz", "t_min", "t_max"};

/// The format of a file of rays, defined by its first line.
struct RayFormat {
    std::string file;             ///< its name, as messages show it
    std::size_t columns = 0;      ///< 6 or 8; 0 until the first line has been read
    std::size_t first_line = 0;   ///< the number of the first line
    std::size_t header_line = 0;  ///< the number of the first line if it is a header, else 0
};

/// Sets the format from the file's first line. Throws FileError for a line that has neither 6 nor 8
/// columns.
void learn(RayFormat& format, const CsvLine& first);

/// Replaces `rays` by the rays of `text`, whole lines of a file. `first_line` is the number of the
/// first of them. Throws FileError, `file:line:column: …`, for a line that is not a ray.
template <class Real>
void read_rays(const RayFormat& format, std::string_view text, std::size_t first_line,
               RayColumns<Real>& rays);

}  // namespace packtrace::cli
