#include "scene/nearest_word.hpp"
#include "scene/quote.hpp"
#include "scene/scene_builder.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace packtrace::reader {
namespace {

struct Model {
    std::string_view name;
    Keys keys;
};

/// In the order of `Illumination`.
const std::array<Model, 5>& models()
{
    static const std::array<Model, 5> all{{
        {"scratch", {"color", "specular", "reflective"}},
        {"sketch", {"color", "ambient", "diffuse", "specular", "refractive", "shininess", "ior"}},
        {"whitted",
         {"color", "ambient", "diffuse", "specular", "transmissive", "shininess", "ior"}},
        {"shader", {"color", "reflectance"}},
        {"general", {"ambient", "diffuse", "highlight", "reflect", "transmit", "shininess", "ior"}},
    }};
    return all;
}

const Model& model_of(Illumination illumination)
{
    return models()[static_cast<std::size_t>(illumination)];
}

bool has_key(const Model& model, std::string_view key)
{
    return std::find(model.keys.begin(), model.keys.end(), key) != model.keys.end();
}

}  // namespace

const Keys& material_keys(Illumination illumination)
{
    return model_of(illumination).keys;
}

void refuse_foreign_keys(const Field& field, Illumination illumination)
{
    const Model& own = model_of(illumination);
    for (const Entry& entry : field.entry.entries) {
        const std::string_view key = entry.key.text;
        const bool foreign = std::any_of(models().begin(), models().end(),
                                         [&](const Model& model) { return has_key(model, key); });
        if (foreign && !has_key(own, key))
            fail(field.source, entry.key.at,
                 quote(key) + " is no material key under illumination = " + std::string(own.name) +
                     "; use " + join(own.keys) + ", or another illumination");
    }
}

}  // namespace packtrace::reader
