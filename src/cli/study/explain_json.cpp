#include <cmath>

#include "cli/study/explain_print.hpp"
#include "lab/harness/names.hpp"

namespace packtrace::cli {
namespace {

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
