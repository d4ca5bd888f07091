#include <packtrace/read_scene.hpp>

#include <algorithm>
#include <map>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "scene/keys.hpp"
#include "scene/quote.hpp"
#include "scene/unit_vector.hpp"

// The steps from the blocks of the syntax tree to a scene. Each throws SceneError at the place that
// is wrong.
namespace packtrace::language {
namespace {

void add(Keys& keys, const Keys& more)
{
    keys.insert(keys.end(), more.begin(), more.end());
}

template <class Owner>
Owner read_block(const Field& field, std::string_view title)
{
    Owner owner;
    read_rows(Block(field, title, keys<Owner>()), owner);
    return owner;
}

/// Throws at `field`, the key look_at, when the view direction is zero or along `up`.
Mat3 view_rotation(const Field& field, const Vec3& position, const Vec3& target, const Vec3& up)
{
    try {
        return look_at(position, target, up);
    } catch (const std::invalid_argument&) {
        field.fail(
            "'look_at' is the camera's own position or straight along 'up'; move one of them "
            "or give another up");
    }
}

void read_camera(const Field& field, Camera& camera)
{
    const auto keys = read_block<CameraKeys>(field, "camera");
    camera.position = keys.position;
    camera.fov = keys.fov;
    if (keys.rotation)
        camera.rotation = *keys.rotation;
    for (const Entry& entry : field.entry.entries)
        if (entry.key.text == "look_at")
            camera.rotation =
                view_rotation({field.source, entry}, keys.position, *keys.look_at, keys.up);
}

Orbit read_orbit(const Field& field, const Camera& camera)
{
    const auto orbit = read_block<Orbit>(field, "orbit");
    const Vec3 arm = camera.position - orbit.center;
    if (arm == Vec3(0.0) ||
        glm::length(glm::cross(unit_vector(orbit.axis), unit_vector(arm))) < 1e-12)
        field.fail(
            "the camera stands on the orbit's axis, where it would not move; give the camera "
            "another position or the orbit another center");
    return orbit;
}

/// The next key of an animation, which has `earlier` ones.
CameraKey read_key(const Field& field, const Animation& earlier)
{
    const auto key = read_block<CameraKey>(field, "key");
    const Block block(field, "key", keys<CameraKey>());
    const Field frame = *block.find("frame");
    check_range(frame, frame.entry.value[0].at, key.frame,
                {.low = 0.0, .high = earlier.frames - 1.0, .whole = true});
    (void)view_rotation(*block.find("look_at"), key.position, key.look_at, key.up);
    if (!earlier.keys.empty() && key.frame <= earlier.keys.back().frame)
        field.fail("frame " + std::to_string(key.frame) + " does not come after frame " +
                   std::to_string(earlier.keys.back().frame) +
                   " of the key before; write keys in rising order");
    return key;
}

Animation read_animation(const Field& field, const Camera& camera)
{
    Keys once = keys<Animation>();
    once.push_back("orbit");
    const Block block(field, "animation", once, {"key"});
    Animation animation;
    read_rows(block, animation);
    for (const Field& key : block.fields())
        if (key.entry.key.text == "key")
            animation.keys.push_back(read_key(key, animation));
    if (const auto orbit = block.find("orbit"))
        animation.orbit = read_orbit(*orbit, camera);
    if (animation.orbit && !animation.keys.empty())
        field.fail(
            "the animation has an orbit and keys, both of which move the camera; remove "
            "one of them");
    if (!animation.orbit && animation.keys.size() < 2)
        field.fail("the animation moves nothing; add orbit { ... } or two or more key { ... }");
    return animation;
}

Keys material_keys(Illumination illumination)
{
    Keys result;
    const Material material = default_material(illumination);
    visit_parts(material, [&](const auto& part) { add(result, keys_of(part)); });
    return result;
}

bool contains(const Keys& keys, std::string_view key)
{
    return std::find(keys.begin(), keys.end(), key) != keys.end();
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
                read_named_material(field);
    }

    [[nodiscard]] Object read(const Field& field, const SurfaceWord& kind)
    {
        refuse_foreign_keys(field);
        Keys repeatable = keys<Mat4>();
        add(repeatable, std::visit([](const auto& surface) { return repeatable_keys_of(surface); },
                                   kind.blank));
        const Block block(field, kind.word, object_keys_.at(kind.word), repeatable);
        Object object;
        object.surface = kind.blank;
        std::visit([&](auto& surface) { read_rows(block, surface); }, object.surface);
        if (auto* const plane = std::get_if<Plane>(&object.surface))
            plane_axes(*plane);
        if (const auto* const polygon = std::get_if<Polygon>(&object.surface))
            if (const auto fault = polygon_fault(*polygon))
                block.find("vertices")->fail(*fault);
        for (const Field& step : block.fields())
            for (const Row<Mat4>& row : rows<Mat4>)
                if (row.key == step.entry.key.text)
                    row.read(step, object.transform);
        ObjectKeys own;
        read_rows(block, own);
        object.casts_shadow = own.casts_shadow;
        read_material(block, own, object);
        object.name = claim_name(block, own.name);
        return object;
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

    /// Throws at a key that belongs to a material, but of another model.
    void refuse_foreign_keys(const Field& field) const
    {
        for (const Entry& entry : field.entry.entries)
            if (contains(foreign_keys_, entry.key.text))
                fail(field.source, entry.key.at,
                     quote(entry.key.text) + " is no material key under illumination = " +
                         std::string(word_of(illumination_)) + "; use " + join(material_keys_) +
                         ", or another illumination");
    }

    void read_named_material(const Field& field)
    {
        refuse_foreign_keys(field);
        const Block block(field, "material", material_keys_);
        if (!field.entry.name || field.entry.name->text.empty())
            field.fail("the material has no name; write material gold { ... }");
        const Word& name = *field.entry.name;
        const auto [earlier, added] = material_lines_.emplace(name.text, name.at.line);
        if (!added)
            fail(field.source, name.at,
                 "material " + quote(name.text) + " is defined twice, first on line " +
                     std::to_string(earlier->second) + "; give one of them another name");
        Material material = default_material(illumination_);
        material.name = name.text;
        visit_parts(material, [&](auto& part) { read_rows(block, part); });
        materials_.emplace(name.text, std::move(material));
    }

    void read_material(const Block& block, const ObjectKeys& own, Object& object) const
    {
        Material& material = object.material;
        material =
            own.material ? named_material(block, *own.material) : default_material(illumination_);
        if (const auto field = block.find("checker")) {
            check_checker(*field, object.surface);
            material.color = own.checker->color;
            material.checker = own.checker->checker;
        }
        if (!own.material)
            visit_parts(material, [&](auto& part) { read_rows(block, part); });
    }

    void check_checker(const Field& field, const Surface& surface) const
    {
        if (!std::holds_alternative<Plane>(surface))
            field.fail("only a plane can have a checker; remove it and use color");
        if (illumination_ == Illumination::general)
            field.fail(
                "'checker' has no effect under illumination = general, whose coefficients "
                "know no colour; remove it");
    }

    [[nodiscard]] const Material& named_material(const Block& block, const std::string& name) const
    {
        for (const std::string_view key : material_keys_)
            if (const auto field = block.find(key))
                field->fail(quote(key) +
                            " stands beside a named material; move it into the material "
                            "or remove 'material'");
        if (const auto found = materials_.find(name); found != materials_.end())
            return found->second;
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

    /// The object's own name, or the next "sphere 1" of its kind; throws if it is in use.
    [[nodiscard]] std::string claim_name(const Block& block, std::optional<std::string> name)
    {
        const Field& object = block.field();
        Position at = object.entry.key.at;
        const std::string kind(object.entry.key.text);
        if (name)
            at = block.find("name")->entry.value[0].at;
        else
            name = kind + ' ' + std::to_string(++unnamed_[kind]);
        const auto [earlier, added] = name_lines_.emplace(*name, at.line);
        if (!added)
            fail(object.source, at,
                 "duplicate name " + quote(*name) + ", in use since line " +
                     std::to_string(earlier->second) + "; give this object another name");
        return *std::move(name);
    }

    Illumination illumination_;
    Keys material_keys_;
    Keys foreign_keys_;
    std::map<std::string_view, Keys> object_keys_;
    std::map<std::string, Material, std::less<>> materials_;
    std::map<std::string_view, std::uint32_t> material_lines_;
    std::map<std::string, std::size_t> unnamed_;
    std::map<std::string, std::uint32_t> name_lines_;
};

void read_objects(const Block& file, Scene& scene)
{
    ObjectReader reader(file, scene.illumination);
    for (const Field& field : file.fields())
        for (const SurfaceWord& kind : surface_words())
            if (kind.word == field.entry.key.text)
                scene.objects.push_back(reader.read(field, kind));
    if (scene.objects.empty())
        fail(file.field().source, {},
             "the scene has no object; add one, e.g. sphere { center = (0, 0, 3) radius = 1 }");
}

Scene build_scene(const Source& source, const Entry& tree)
{
    Keys once = keys<Scene>();
    add(once, {"camera", "animation"});
    Keys repeatable;
    for (const SurfaceWord& kind : surface_words())
        repeatable.push_back(kind.word);
    add(repeatable, {"light", "material"});
    const Block file({source, tree}, "the scene", once, repeatable);

    const auto illumination = file.find("illumination");
    Scene scene = default_scene(illumination ? choice<Illumination>().read(*illumination)
                                             : Scene{}.illumination);
    read_rows(file, scene);
    if (const auto camera = file.find("camera"))
        read_camera(*camera, scene.camera);
    read_objects(file, scene);
    for (const Field& field : file.fields())
        if (field.entry.key.text == "light")
            scene.lights.push_back(read_block<Light>(field, "light"));
    if (const auto animation = file.find("animation"))
        scene.animation = read_animation(*animation, scene.camera);
    return scene;
}

}  // namespace
}  // namespace packtrace::language

namespace packtrace {

Scene parse_scene(std::string_view text, const std::string& name, const TakeWarning& warn)
{
    const language::Source source{name, text, warn};
    language::check_text(source);
    return language::build_scene(source, language::parse_tree(source));
}

Scene read_scene(const std::filesystem::path& file, const TakeWarning& warn)
{
    return parse_scene(language::load_text(file), file.string(), warn);
}

}  // namespace packtrace
