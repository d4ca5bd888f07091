#include "scene/nearest_word.hpp"

#include "scene/quote.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace packtrace::reader {
namespace {

constexpr std::size_t largest_slip = 2;

/// Optimal string alignment distance (Damerau, A Technique for Computer Detection and
/// Correction of Spelling Errors, 1964), row by row.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    std::iota(above.begin(), above.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before.swap(above);
        above.swap(row);
    }
    return above[b.size()];
}

}  // namespace

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known)
{
    std::string_view nearest;
    // A word of two letters is two slips away from any other.
    std::size_t limit = std::min(largest_slip + 1, word.size());
    for (const std::string_view candidate : known) {
        if (word.size() > candidate.size() + largest_slip)
            continue;
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < limit) {
            limit = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string suggest(std::string_view word, std::span<const std::string_view> known)
{
    const std::string_view nearest = nearest_word(word, known);
    if (!nearest.empty())
        return "did you mean " + quote(nearest) + "?";
    return "use one of: " + join(known);
}

std::string join(std::span<const std::string_view> words)
{
    std::string result;
    for (const std::string_view word : words)
        result += (result.empty() ? "" : ", ") + escape(word);
    return result;
}

}  // namespace packtrace::reader
