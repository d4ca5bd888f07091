#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace packtrace::cli {

/// A line of a CSV file without its line end.
struct CsvLine {
    std::string_view text;
    std::size_t number = 1;  ///< in the file, from 1
};

/// Walks the lines of a text that are neither blank nor # comments. Lines end in LF or CR LF;
/// the last may lack its end.
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

    /// The number of the line after those walked.
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

}  // namespace packtrace::cli
