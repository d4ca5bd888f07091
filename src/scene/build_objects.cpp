#include "scene/quote.hpp"
#include "scene/scene_builder.hpp"
#include "scene/values.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace packtrace::reader {
namespace {

/// Gives each object its own name, or the next "sphere 1" of its kind.
class Namer {
public:
    [[nodiscard]] std::string name(const Field& object)
    {
        const std::string keyword(object.entry.key.text);
        for (const Entry& entry : object.entry.entries)
            if (entry.key.text == "name")
                return given({object.source, entry});
        return claim(object, object.entry.key.at,
                     keyword + ' ' + std::to_string(++unnamed_[keyword]));
    }

private:
    std::string given(const Field& field)
    {
        const std::string_view name = read_name(field);
        const Position at = field.entry.value[0].at;
        if (name.empty())
            fail(field.source, at, "the name is empty; write one or remove the key");
        return claim(field, at, std::string(name));
    }

    std::string claim(const Field& field, Position at, std::string name)
    {
        const auto [earlier, added] = lines_.emplace(std::move(name), at.line);
        if (!added)
            fail(field.source, at,
                 "duplicate name " + quote(earlier->first) + ", in use since line " +
                     std::to_string(earlier->second) + "; give this object another name");
        return earlier->first;
    }

    std::map<std::string, std::size_t> unnamed_;
    std::map<std::string, std::uint32_t> lines_;
};

}  // namespace

void build_objects(const Block& file, const NamedMaterials& materials, Scene& scene)
{
    Namer namer;
    for (const Field& field : file.fields()) {
        if (!is_surface(field.entry.key.text))
            continue;
        scene.objects.push_back(build_object(field, scene.illumination, materials));
        scene.objects.back().name = namer.name(field);
    }
    if (scene.objects.empty())
        fail(file.field().source, {},
             "the scene has no object; add one, e.g. sphere { center = (0, 0, 3) radius = 1 }");
}

}  // namespace packtrace::reader
