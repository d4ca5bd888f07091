#include "cli/output/text_table.hpp"

#include <algorithm>
#include <ostream>
#include <utility>

namespace packtrace::cli {
TextTable::TextTable(std::size_t left, std::vector<std::string> head) : left_(left)
{
    rows_.push_back(std::move(head));
}

void TextTable::add(std::vector<std::string> row)
{
    rows_.push_back(std::move(row));
}

void TextTable::print(std::ostream& to) const
{
    std::vector<std::size_t> widths(rows_.front().size());
    for (const auto& row : rows_)
        for (std::size_t c = 0; c < widths.size(); ++c)
            widths[c] = std::max(widths[c], row[c].size());
    for (const auto& row : rows_) {
        std::string line;
        for (std::size_t c = 0; c < widths.size(); ++c) {
            const std::string pad(widths[c] - row[c].size(), ' ');
            line += (c > 0 ? "  " : "") + (c < left_ ? row[c] + pad : pad + row[c]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        to << line << '\n';
    }
}

std::string milliseconds(double seconds)
{
    return fixed(1e3 * seconds, 3);
}

std::string percent(double part, double whole)
{
    return fixed(100.0 * part / whole, 1) + " %";
}

}  // namespace packtrace::cli
