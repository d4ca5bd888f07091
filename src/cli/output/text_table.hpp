#pragma once

#include "core/text.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace packtrace::cli {

/// Rows of words, printed in columns. The first `left` columns are aligned left, the others right.
class TextTable {
public:
    TextTable(std::size_t left, std::vector<std::string> head);

    /// A row must have as many words as the head.
    void add(std::vector<std::string> row);
    void print(std::ostream& to) const;

private:
    std::size_t left_;
    std::vector<std::vector<std::string>> rows_;
};

[[nodiscard]] std::string milliseconds(double seconds);
/// The share of `part` in `whole` in percent, with one decimal and the percent sign.
[[nodiscard]] std::string percent(double part, double whole);

}  // namespace packtrace::cli
