#include "scene/language/keys.hpp"
#include "scene/object_names.hpp"
#include <packtrace/validate.hpp>
#include <packtrace/write_scene.hpp>

#include <map>
#include <string>

namespace packtrace::language {
namespace {

class SceneWriter {
public:
    [[nodiscard]] SceneText write(const Scene& scene)
    {
        keys_ += write_rows(out_, scene, "", " = ", "\n");
        write_block("camera", keys_of_camera(scene.camera));
        for (const Light& light : scene.lights)
            write_block("light", light);
        if (scene.animation)
            write_animation(*scene.animation);
        write_materials(scene);
        for (const Object& object : scene.objects)
            write_object(object);
        return {std::move(out_), keys_};
    }

private:
    void open(std::string_view key)
    {
        out_.append(key).append(" {");
        ++keys_;
    }

    template <class Owner>
    void write_block(std::string_view key, const Owner& owner)
    {
        open(key);
        keys_ += write_rows(out_, owner);
        out_ += " }\n";
    }

    void write_animation(const Animation& animation)
    {
        open("animation");
        keys_ += write_rows(out_, animation);
        out_ += '\n';
        if (animation.orbit)
            write_block("orbit", *animation.orbit);
        for (const CameraKey& key : animation.keys)
            write_block("key", key);
        out_ += "}\n";
    }

    /// The keys of a material, each after a blank.
    std::string material_text(const Material& material)
    {
        std::string text;
        visit_parts(material, [&](const auto& part) { keys_ += write_rows(text, part); });
        return text;
    }

    /// Writes the named materials, each as its first object has it.
    void write_materials(const Scene& scene)
    {
        for (const Object& object : scene.objects) {
            if (object.material.name.empty() || materials_.contains(object.material.name))
                continue;
            Material material = object.material;
            // The colours of a checker belong to the object, not to the named material.
            if (material.checker.reset(), object.material.checker)
                material.color = Rgb(1.0);
            open("material ");
            out_.erase(out_.size() - 2);
            name().write(out_, material.name);
            std::string text = material_text(material);
            out_.append(" {").append(text).append(" }\n");
            materials_.emplace(material.name, std::move(text));
        }
    }

    /// The keys of the object's material, or nothing if it equals the named one.
    std::string own_material_text(const Material& material)
    {
        const auto named = materials_.find(material.name);
        if (named == materials_.end())
            return material_text(material);
        Material plain = material;
        plain.checker.reset();
        if (material.checker)
            plain.color = Rgb(1.0);
        const std::size_t keys = keys_;
        const bool same = material_text(plain) == named->second;
        keys_ = keys;
        return same ? "" : material_text(material);
    }

    void write_object(const Object& object)
    {
        const Material& material = object.material;
        ObjectKeys own;
        own.casts_shadow = object.casts_shadow;
        // Default names are not written.
        if (!names_.takes(object))
            own.name = object.name;
        if (!material.name.empty())
            own.material = material.name;
        if (material.checker)
            own.checker = {material.color, *material.checker};

        open(word_of(object.surface).word);
        std::visit([&](const auto& surface) { keys_ += write_rows(out_, surface); },
                   object.surface);
        if (const auto* const polygon = std::get_if<Polygon>(&object.surface))
            keys_ += polygon->contours.size();
        keys_ += write_rows(out_, object.transform);
        out_ += own_material_text(material);
        keys_ += write_rows(out_, own);
        out_ += " }\n";
    }

    std::string out_;
    std::size_t keys_ = 0;
    /// The keys of every named material, from material_text().
    std::map<std::string, std::string, std::less<>> materials_;
    DefaultNames names_;
};

}  // namespace

SceneText write_unchecked(const Scene& scene)
{
    return SceneWriter().write(scene);
}

}  // namespace packtrace::language

namespace packtrace {

std::string scene_text(const Scene& scene)
{
    validate(scene);
    language::SceneText written = language::write_unchecked(scene);
    if (written.keys > language::most_keys || written.text.size() > language::longest_file)
        throw SceneError("the scene's text has " + std::to_string(written.keys) + " keys and " +
                         std::to_string(written.text.size()) +
                         " bytes, too many for a scene file; keep it within " +
                         std::to_string(language::most_keys) + " keys and " +
                         std::to_string(language::longest_file) + " bytes");
    return std::move(written.text);
}

}  // namespace packtrace
