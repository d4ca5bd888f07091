#include "scene/language/read_objects.hpp"

#include "scene/language/keys.hpp"
#include "scene/language/quote.hpp"
#include "scene/object_names.hpp"
#include "scene/scene_faults.hpp"

#include <map>

namespace packtrace::language {
namespace {

Keys material_keys(Illumination illumination)
{
    Keys result;
    const Material material = default_material(illumination);
    visit_parts(material, [&](const auto& part) { add(result, keys_of(part)); });
    return result;
}

/// Reads the objects of a scene and the materials they use.
class ObjectReader {
public:
    ObjectReader(const Block& file, Illumination illumination)
        : illumination_(illumination), material_keys_(material_keys(illumination))
    {
        for (const auto& [other, word] : spellings(illumination))
            for (const std::string_view key : material_keys(other))
                if (!contains(material_keys_, key))
                    foreign_keys_.push_back(key);
        for (const SurfaceWord& surface : surface_words())
            object_keys_.emplace(surface.word, keys_of_object(surface.blank));
        for (const Field& field : file.fields())
            if (field.entry.key.text == "material")
                add_named_material(field);
    }

    [[nodiscard]] Object read(const Field& field, const SurfaceWord& kind)
    {
        refuse_foreign_keys(field);
        Keys repeatable = keys<Mat4>();
        add(repeatable, std::visit([](const auto& surface) { return repeatable_keys_of(surface); },
                                   kind.blank));
        Block block(field, kind.word, object_keys_.at(kind.word), repeatable);
        const auto own_name = name_in(block);
        const std::size_t number = own_name ? 0 : ++unnamed_[kind.word];
        const std::string subject = label_of(kind.word, own_name, number);
        block.set_subject(subject);

        Object object{.surface = kind.blank};
        std::visit([&](auto& surface) { read_rows(block, surface); }, object.surface);
        if (auto* const plane = std::get_if<Plane>(&object.surface))
            plane_axes(*plane);
        if (const OwnerFault fault = fault_of_surface(object.surface))
            refuse(block, *fault);
        for (const Field& step : block.fields())
            for (const Row<Mat4>& row : rows<Mat4>)
                if (row.key == step.entry.key.text)
                    row.read(step, object.transform);
        ObjectKeys own;
        read_rows(block, own);
        object.casts_shadow = own.casts_shadow;
        read_material(block, own, object);
        object.name = own_name ? *own_name : label_of(kind.word, std::nullopt, number);
        if (const OwnerFault fault = fault_of_object(object, illumination_))
            refuse(block, *fault);
        return object;
    }

    /// Reads the materials that no object uses, to find their faults.
    void read_unused_materials()
    {
        for (auto& [name, material] : materials_)
            (void)read_named_material(material);
    }

private:
    [[nodiscard]] Keys keys_of_object(const Surface& blank) const
    {
        Keys result = std::visit([](const auto& surface) { return keys_of(surface); }, blank);
        const Keys repeatable =
            std::visit([](const auto& surface) { return repeatable_keys_of(surface); }, blank);
        std::erase_if(result, [&](std::string_view key) { return contains(repeatable, key); });
        add(result, material_keys_);
        add(result, keys<ObjectKeys>());
        return result;
    }

    /// Throws SceneError at a key that belongs to the material of another model.
    void refuse_foreign_keys(const Field& field) const
    {
        for (const Entry& entry : field.entry.entries)
            if (contains(foreign_keys_, entry.key.text))
                fail(field.source, entry.key.at,
                     quote(entry.key.text) + " is no material key under illumination = " +
                         std::string(word_of(illumination_)) + "; use " + join(material_keys_) +
                         ", or another illumination");
    }

    /// A named material. Its block is read at its first use; without a use, at the end.
    struct NamedMaterial {
        Field field;
        std::optional<Material> material{};
    };

    void add_named_material(const Field& field)
    {
        refuse_foreign_keys(field);
        const Block block(field, "material", material_keys_);
        if (!field.entry.name || field.entry.name->text.empty())
            field.fail("the material has no name; write material gold { ... }");
        const Word& name = *field.entry.name;
        const auto [earlier, added] =
            materials_.emplace(name.text, NamedMaterial{{field.source, field.entry}});
        if (!added)
            fail(field.source, name.at,
                 "material " + quote(name.text) + " is defined twice, first on line " +
                     std::to_string(earlier->second.field.entry.name->at.line) +
                     "; give one of them another name");
    }

    [[nodiscard]] const Material& read_named_material(NamedMaterial& named) const
    {
        if (!named.material) {
            Block block(named.field, "material", material_keys_);
            const std::string_view name = named.field.entry.name->text;
            const std::string subject = "material " + quote(name);
            block.set_subject(subject);
            Material material = default_material(illumination_);
            material.name = name;
            visit_parts(material, [&](auto& part) { read_rows(block, part); });
            named.material = std::move(material);
        }
        return *named.material;
    }

    /// Keys of the object override those of its named material.
    void read_material(const Block& block, const ObjectKeys& own, Object& object)
    {
        Material& material = object.material;
        const auto checker = block.find("checker");
        if (checker)
            check_checker(*checker, object.surface);
        material =
            own.material ? named_material(block, *own.material) : default_material(illumination_);
        if (checker) {
            material.color = own.checker->color;
            material.checker = own.checker->checker;
        }
        visit_parts(material, [&](auto& part) { read_rows(block, part); });
    }

    void check_checker(const Field& field, const Surface& surface) const
    {
        if (!std::holds_alternative<Plane>(surface))
            field.refuse(field.entry.key.at, std::string(checker_of_no_plane));
        if (illumination_ == Illumination::general)
            field.refuse(field.entry.key.at, std::string(checker_without_color));
    }

    [[nodiscard]] const Material& named_material(const Block& block, const std::string& name)
    {
        if (const auto found = materials_.find(name); found != materials_.end())
            return read_named_material(found->second);
        Keys names;
        for (const auto& [known, material] : materials_)
            names.push_back(known);
        const std::string_view nearest = nearest_word(name, names);
        const Field field = *block.find("material");
        fail(field.source, field.entry.value[0].at,
             "unknown material " + quote(name) +
                 (nearest.empty()
                      ? "; define it with: material " + escape(name.substr(0, 40)) + " { ... }"
                      : "; did you mean " + quote(nearest) + "?"));
    }

    /// The object's own name, if it has one.
    [[nodiscard]] static std::optional<std::string> name_in(const Block& block)
    {
        const auto field = block.find("name");
        return field ? std::optional(language::name().read(*field)) : std::nullopt;
    }

    Illumination illumination_;
    Keys material_keys_;
    Keys foreign_keys_;
    std::map<std::string_view, Keys> object_keys_;
    std::map<std::string, NamedMaterial, std::less<>> materials_;
    std::map<std::string_view, std::size_t> unnamed_;
};

}  // namespace

void read_objects(const Block& file, Scene& scene)
{
    ObjectReader reader(file, scene.illumination);
    for (const Field& field : file.fields())
        for (const SurfaceWord& kind : surface_words())
            if (kind.word == field.entry.key.text)
                scene.objects.push_back(reader.read(field, kind));
    if (scene.objects.empty())
        warn(file.field().source, {},
             "the scene has no object, its picture is all background; add one, e.g. "
             "sphere { center = (0, 0, 3) radius = 1 }");
    reader.read_unused_materials();
}

Field object_field(const Block& file, std::size_t number)
{
    for (const Field& field : file.fields())
        for (const SurfaceWord& kind : surface_words())
            if (kind.word == field.entry.key.text && number-- == 0)
                return field;
    return file.field();
}

}  // namespace packtrace::language
