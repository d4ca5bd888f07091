#include "cli/study/explain_print.hpp"

#include <algorithm>
#include <cstdio>
#include <ostream>

namespace packtrace::cli {
namespace {

struct Line {
    std::string label;
    std::string first;
    std::string second;
    bool marked = false;
};

std::string in_words(const std::vector<double>& numbers, int digits)
{
    std::string text;
    char word[40];
    for (const double number : numbers) {
        std::snprintf(word, sizeof word, "%.*g", digits, number);
        text += (text.empty() ? "" : ", ") + std::string(word);
    }
    return text.empty() ? "-" : text;
}

std::string value_of(const Scene& scene, const TreeRow& row, const std::vector<double>& numbers,
                     int digits)
{
    if (row.field != "object" || numbers.empty())
        return in_words(numbers, digits);
    const auto object = static_cast<int>(numbers[0]);
    return object < 0 ? "nothing" : scene.objects[static_cast<std::size_t>(object)].name;
}

// "camera, mirrored, refracted" is a refracted ray.
std::string heading(const TreeRow& row)
{
    const std::size_t comma = row.ray.rfind(", ");
    return row.ray.substr(comma == std::string::npos ? 0 : comma + 2) + " ray";
}

std::vector<Line> lines_of(const Scene& scene, const Explanation& explanation)
{
    // Enough to see a difference of the tolerance, and a little more.
    const int digits = explanation.precision == "double" ? 12 : 7;
    const TreeRow* const different = first_difference(explanation);
    std::vector<Line> lines{{"", "reference", "packets"}};
    std::string ray;
    for (const TreeRow& row : explanation.rows) {
        const std::string indent(2 * static_cast<std::size_t>(row.depth), ' ');
        if (row.ray != ray)
            lines.push_back({indent + heading(row), "", ""});
        ray = row.ray;
        lines.push_back({indent + "  " + row.field, value_of(scene, row, row.first, digits),
                         value_of(scene, row, row.second, digits), &row == different});
    }
    const auto sum = [&](const RayNode& tree) {
        const Rgb color = sum_of(tree);
        return in_words({color.x, color.y, color.z}, digits);
    };
    lines.push_back({"pixel", sum(explanation.reference), sum(explanation.packets)});
    return lines;
}

std::string padded(const std::string& text, std::size_t width)
{
    return text + std::string(width - std::min(width, text.size()), ' ');
}

void print_lines(std::ostream& to, const std::vector<Line>& lines)
{
    std::size_t label = 0;
    std::size_t first = 0;
    std::size_t second = 0;
    for (const Line& line : lines) {
        label = std::max(label, line.label.size());
        first = std::max(first, line.first.size());
        second = std::max(second, line.second.size());
    }
    for (const Line& line : lines) {
        std::string text = padded(line.label, label + 2) + padded(line.first, first + 2) +
                           padded(line.second, second + 2);
        if (line.marked)
            text += "<-- first difference";
        text.erase(text.find_last_not_of(' ') + 1);
        to << text << '\n';
    }
}

}  // namespace

const TreeRow* first_difference(const Explanation& explanation)
{
    const auto row = std::find_if(explanation.rows.begin(), explanation.rows.end(),
                                  [](const TreeRow& each) { return each.differs; });
    return row == explanation.rows.end() ? nullptr : &*row;
}

void print_explanation(std::ostream& to, const Scene& scene, const Explanation& explanation)
{
    to << explanation.file << ": pixel " << explanation.x << "," << explanation.y << " of "
       << scene.width << " x " << scene.height
       << "\nreference: scalar, double; packets: " << explanation.isa << ", "
       << explanation.precision << "\n\n";
    print_lines(to, lines_of(scene, explanation));
    const TreeRow* const row = first_difference(explanation);
    to << '\n';
    if (row == nullptr)
        to << "no difference beyond " << in_words({explanation.tolerance}, 3) << '\n';
    else
        to << "first difference beyond " << in_words({explanation.tolerance}, 3) << ": " << row->ray
           << ": " << row->field << '\n';
}

}  // namespace packtrace::cli
