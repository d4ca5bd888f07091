#include "cli/study/explain_print.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "lab/harness/names.hpp"

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

using Json = nlohmann::ordered_json;

Json triple(const Vec3& v)
{
    return {v.x, v.y, v.z};
}

Json lights_json(const RayNode& ray)
{
    Json lights = Json::array();
    for (const LightShare& light : ray.lights)
        lights.push_back({{"light", light.light + 1},
                          {"share", light.share ? triple(*light.share) : Json(nullptr)},
                          {"color", triple(light.color)}});
    return lights;
}

Json ray_json(const Scene& scene, const RayNode& ray)
{
    Json json{{"kind", name_of(ray.kind)},
              {"origin", triple(ray.org)},
              {"direction", triple(ray.dir)},
              {"weight", triple(ray.weight)},
              {"object", nullptr}};
    if (ray.object >= 0) {
        json["object"] = scene.objects[static_cast<std::size_t>(ray.object)].name;
        json["t"] = ray.t;
        json["point"] = triple(ray.point);
        json["normal"] = triple(ray.normal);
        json["lights"] = lights_json(ray);
    }
    json["local"] = triple(ray.local);
    json["brought"] = triple(ray.brought);
    json["children"] = Json::array();
    for (const RayNode& child : ray.children)
        json["children"].push_back(ray_json(scene, child));
    return json;
}

Json tree_json(const Scene& scene, const RayNode& tree)
{
    return {{"color", triple(sum_of(tree))}, {"tree", ray_json(scene, tree)}};
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

Json explanation_json(const Scene& scene, const Explanation& explanation)
{
    const TreeRow* const row = first_difference(explanation);
    return {{"scene", explanation.file},
            {"pixel", {{"x", explanation.x}, {"y", explanation.y}}},
            {"width", scene.width},
            {"height", scene.height},
            {"isa", explanation.isa},
            {"precision", explanation.precision},
            {"tolerance", explanation.tolerance},
            {"first_difference",
             row == nullptr ? Json(nullptr) : Json{{"ray", row->ray}, {"field", row->field}}},
            {"reference", tree_json(scene, explanation.reference)},
            {"packets", tree_json(scene, explanation.packets)}};
}

}  // namespace packtrace::cli
