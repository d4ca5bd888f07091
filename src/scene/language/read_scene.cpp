#include "scene/elliptic_sections.hpp"
#include "scene/language/keys.hpp"
#include "scene/language/quote.hpp"
#include "scene/language/read_objects.hpp"
#include "scene/object_names.hpp"
#include "scene/scene_faults.hpp"
#include <packtrace/read_scene.hpp>

#include <algorithm>
#include <stdexcept>

// Converts the blocks of the syntax tree to a scene. All functions throw SceneError at the position
// of the error.
namespace packtrace::language {
namespace {

/// `subject` names the block in messages about values: "light 2".
template <class Owner>
Owner read_block(const Field& field, std::string_view title, std::string_view subject)
{
    Owner owner;
    Block block(field, title, keys<Owner>());
    block.set_subject(subject);
    read_rows(block, owner);
    return owner;
}

/// Throws SceneError at the key look_at if the view direction is zero or along `up`.
Mat3 view_rotation(const Field& field, const CameraKeys& keys)
{
    try {
        return look_at(keys.position, *keys.look_at, keys.up);
    } catch (const std::invalid_argument&) {
        field.refuse(field.entry.key.at, std::string(looks_nowhere));
    }
}

void read_camera(const Field& field, Camera& camera)
{
    const auto keys = read_block<CameraKeys>(field, "camera", "camera");
    camera.position = keys.position;
    camera.fov = keys.fov;
    if (keys.rotation)
        camera.rotation = *keys.rotation;
    for (const Entry& entry : field.entry.entries)
        if (entry.key.text == "look_at")
            camera.rotation = view_rotation({field.source, entry, "camera"}, keys);
}

Orbit read_orbit(const Field& field, const Camera& camera)
{
    const auto orbit = read_block<Orbit>(field, "orbit", "orbit");
    if (const OwnerFault fault = fault_of_orbit(orbit, camera))
        Field{field.source, field.entry, "orbit"}.refuse(field.entry.key.at, fault->message);
    return orbit;
}

/// Reads the next key of an animation, after the keys of `earlier`.
CameraKey read_key(const Field& field, const Animation& earlier)
{
    const std::string subject = "key " + std::to_string(earlier.keys.size() + 1);
    const auto key = read_block<CameraKey>(field, "key", subject);
    Block block(field, "key", keys<CameraKey>());
    block.set_subject(subject);
    const int last = earlier.keys.empty() ? -1 : earlier.keys.back().frame;
    if (const OwnerFault fault = fault_of_key(key, earlier.frames, last)) {
        // A fault of the frame is reported at its number.
        if (fault->key == "frame")
            block.find("frame")->refuse(block.find("frame")->entry.value[0].at, fault->message);
        refuse(block, *fault);
    }
    return key;
}

Animation read_animation(const Field& field, const Camera& camera)
{
    Keys once = keys<Animation>();
    once.push_back("orbit");
    Block block(field, "animation", once, {"key"});
    block.set_subject("animation");
    Animation animation;
    read_rows(block, animation);
    for (const Field& key : block.fields())
        if (key.entry.key.text == "key")
            animation.keys.push_back(read_key(key, animation));
    if (const auto orbit = block.find("orbit"))
        animation.orbit = read_orbit(*orbit, camera);
    if (const OwnerFault fault = fault_of_animation(animation))
        refuse(block, *fault);
    return animation;
}

void read_lights(const Block& file, Scene& scene)
{
    for (const Field& field : file.fields())
        if (field.entry.key.text == "light")
            scene.lights.push_back(read_block<Light>(
                field, "light", "light " + std::to_string(scene.lights.size() + 1)));
}

/// Throws SceneError if colours may grow too much.
void check_growth(const Block& file, const Scene& scene)
{
    if (const auto fault = fault_of_growth(scene)) {
        const Field object = object_field(file, fault->index);
        fail(object.source, object.entry.key.at, fault->text());
    }
}

/// Warns of duplicate names, because reports and messages identify objects by name.
void warn_of_duplicate_name(const Block& file, const Scene& scene)
{
    const auto repeated = find_duplicate_name(scene);
    if (!repeated)
        return;
    const Field object = object_field(file, repeated->object);
    Position at = object.entry.key.at;
    for (const Entry& entry : object.entry.entries)
        if (entry.key.text == "name")
            at = entry.value[0].at;
    const Position earlier = object_field(file, repeated->earlier).entry.key.at;
    warn(object.source, at,
         "duplicate name " + quote(scene.objects[repeated->object].name) +
             ", that of the object on line " + std::to_string(earlier.line) +
             " too; give one of them another name");
}

bool is_clipped_away(const Object& object)
{
    const Quadric* const quadric = std::get_if<Quadric>(&object.surface);
    const auto sections = quadric != nullptr ? elliptic_sections(*quadric) : std::nullopt;
    return sections && sections->widest < 0.0;
}

/// Warns of the first object that is clipped away, and says how many more there are.
void warn_of_empty_clips(const Block& file, const Scene& scene)
{
    const auto& objects = scene.objects;
    const auto first = std::find_if(objects.begin(), objects.end(), is_clipped_away);
    if (first == objects.end())
        return;
    const Field object = object_field(file, static_cast<std::size_t>(first - objects.begin()));
    Position at = object.entry.key.at;
    for (const Entry& entry : object.entry.entries)
        if (entry.key.text == "z_range")
            at = entry.key.at;
    const auto more = std::count_if(first + 1, objects.end(), is_clipped_away);
    warn(object.source, at,
         "'z_range' leaves nothing of the surface, which has no point at these heights of its own "
         "space; give others" +
             (more > 0 ? " (and so of " + std::to_string(more) + " more)" : std::string()));
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
    read_lights(file, scene);
    if (const auto animation = file.find("animation"))
        scene.animation = read_animation(*animation, scene.camera);
    check_growth(file, scene);
    warn_of_duplicate_name(file, scene);
    warn_of_empty_clips(file, scene);
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
