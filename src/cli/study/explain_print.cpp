#include "cli/study/explain_print.hpp"

#include "cli/output/text_table.hpp"
#include "lab/harness/names.hpp"
#include "render/option_words.hpp"

#include <algorithm>
#include <ostream>

namespace packtrace::cli {
namespace {

std::string in_words(const std::vector<double>& numbers, int digits)
{
    if (numbers.empty())
        return "-";
    return joined(numbers, ", ", [&](double number) { return brief(number, digits); });
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

TextTable lines_of(const Scene& scene, const Explanation& explanation)
{
    // Enough digits to show a difference of the tolerance.
    const int digits = explanation.precision == Precision::double_ ? 12 : 7;
    const TreeRow* const different = first_difference(explanation);
    TextTable lines(4, {"", "reference", "packets", ""});
    std::string ray;
    for (const TreeRow& row : explanation.rows) {
        const std::string indent(2 * static_cast<std::size_t>(row.depth), ' ');
        if (row.ray != ray)
            lines.add({indent + heading(row), "", "", ""});
        ray = row.ray;
        lines.add({indent + "  " + row.field, value_of(scene, row, row.first, digits),
                   value_of(scene, row, row.second, digits),
                   &row == different ? "<-- first difference" : ""});
    }
    const auto sum = [&](const RayNode& tree) {
        const Rgb color = sum_of(tree);
        return in_words({color.x, color.y, color.z}, digits);
    };
    lines.add({"pixel", sum(explanation.reference), sum(explanation.packets), ""});
    return lines;
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
       << language::word_of(explanation.precision) << "\n\n";
    lines_of(scene, explanation).print(to);
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
            {"precision", language::word_of(explanation.precision)},
            {"tolerance", explanation.tolerance},
            {"first_difference",
             row == nullptr ? Json(nullptr) : Json{{"ray", row->ray}, {"field", row->field}}},
            {"reference", tree_json(scene, explanation.reference)},
            {"packets", tree_json(scene, explanation.packets)}};
}

}  // namespace packtrace::cli
