#include "scene/scene_faults.hpp"

#include "scene/language/keys.hpp"
#include "scene/language/quote.hpp"
#include "scene/object_names.hpp"
#include "scene/vectors.hpp"
#include <packtrace/validate.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace packtrace::language {
namespace {

OwnerFault fault_at(std::string_view key, Fault fault)
{
    return fault ? OwnerFault({key, *std::move(fault)}) : std::nullopt;
}

/// The fault of a transform that moves a point of object space too far away.
OwnerFault fault_of_point(const Mat4& transform, const Vec3& point)
{
    const Vec3 place(transform * glm::dvec4(point, 1.0));
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(place[axis]) <= largest_number))
            return KeyFault{"matrix", "the transform takes it to (" + to_text(place.x) + ", " +
                                          to_text(place.y) + ", " + to_text(place.z) +
                                          "), too far for single precision; stay within " +
                                          shortest(largest_number) + " of the origin"};
    return std::nullopt;
}

/// The fault of a transform that scales `size`, a length in object space, too much. The scale is
/// the geometric mean over all directions.
OwnerFault fault_of_size(const Mat4& transform, double size)
{
    const double scaled = std::cbrt(std::abs(glm::determinant(Mat3(transform)))) * size;
    if (any_length.can_hold(scaled))
        return std::nullopt;
    return KeyFault{"matrix", "the transform makes its size " + to_text(scaled) + ", too " +
                                  (scaled > 1.0 ? "large" : "small") +
                                  " for single precision; stay within " +
                                  shortest(smallest_length) + " and " + shortest(largest_number)};
}

OwnerFault fault_of_place(const Mat4& transform, const Surface& surface)
{
    OwnerFault fault;
    if (const auto* const sphere = std::get_if<Sphere>(&surface)) {
        fault = fault_of_point(transform, sphere->center);
        return fault ? fault : fault_of_size(transform, sphere->radius);
    }
    if (const auto* const plane = std::get_if<Plane>(&surface))
        return fault_of_point(transform, plane->point);
    if (const auto* const polygon = std::get_if<Polygon>(&surface))
        for (const std::vector<Vec3>& contour : polygon->contours)
            for (const Vec3& corner : contour)
                if (!fault)
                    fault = fault_of_point(transform, corner);
    return fault;
}

Illumination illumination_of(const Material& material)
{
    // The alternatives have the order of the enumeration.
    return static_cast<Illumination>(material.model.index());
}

Fault fault_of_model(const Material& material, Illumination illumination)
{
    if (illumination_of(material) == illumination)
        return std::nullopt;
    return "the material is one of illumination = " +
           std::string(word_of(illumination_of(material))) + ", the scene's is " +
           std::string(word_of(illumination)) + "; give it the scene's, see make_material()";
}

/// Whether the plane's axes differ from plane_axes(). Only a checker uses them.
bool has_own_axes(const Plane& plane)
{
    Plane own = plane;
    plane_axes(own);
    return own.u == plane.u && own.v == plane.v;
}

OwnerFault fault_of_checker(const Object& object, Illumination illumination)
{
    const Material& material = object.material;
    if (!material.checker)
        return std::nullopt;
    const auto* const plane = std::get_if<Plane>(&object.surface);
    if (plane == nullptr)
        return KeyFault{"checker", std::string(checker_of_no_plane)};
    if (illumination == Illumination::general)
        return KeyFault{"checker", std::string(checker_without_color)};
    if (!has_own_axes(*plane))
        return KeyFault{"checker",
                        "the plane's axes u and v are not those of its normal; call plane_axes() "
                        "or use plane()"};
    return std::nullopt;
}

OwnerFault fault_of_names(const Object& object)
{
    if (!object.name.empty())
        if (OwnerFault fault = fault_at("name", name().check("name", object.name)))
            return fault;
    if (!object.material.name.empty())
        return fault_at("material", name().check("material", object.material.name));
    return std::nullopt;
}

OwnerFault fault_of_material(const Material& material)
{
    OwnerFault fault;
    visit_parts(material, [&](const auto& part) {
        if (!fault)
            fault = fault_in_rows(part);
    });
    return fault;
}

/// The first fault of an object's names and material.
OwnerFault fault_of_looks(const Object& object, Illumination illumination)
{
    OwnerFault fault = fault_of_names(object);
    if (!fault)
        fault = fault_at("material", fault_of_model(object.material, illumination));
    if (!fault)
        fault = fault_of_checker(object, illumination);
    if (!fault && object.material.checker) {
        const CheckerValue value{object.material.color, *object.material.checker};
        fault = fault_at("checker", checker().check("checker", value));
    }
    if (!fault && illumination == Illumination::general && object.material.color != Rgb(1.0))
        fault = KeyFault{"color",
                         "a material of illumination = general has no colour; leave it (1, 1, 1)"};
    if (!fault)
        fault = fault_of_material(object.material);
    return fault;
}

/// The subject of an object's fault. A fault of a named material belongs to the material's block if
/// the first object with that name has it.
std::string subject_of(const Scene& scene, std::size_t object, const KeyFault& fault)
{
    const Material& material = scene.objects[object].material;
    const OwnerFault own = fault_of_material(material);
    const auto has_name = [&](const Object& other) { return other.material.name == material.name; };
    const auto first = std::find_if(scene.objects.begin(), scene.objects.end(), has_name);
    const bool in_block = !material.name.empty() && own && own->message == fault.message &&
                          first - scene.objects.begin() == static_cast<std::ptrdiff_t>(object);
    return in_block ? "material " + quote(material.name) : label_of(scene, object);
}

/// The first number below `count` that `is_faulty`, else `count`.
template <class IsFaulty>
std::size_t first_faulty(std::size_t count, const IsFaulty& is_faulty)
{
    constexpr std::size_t task_objects = 4096;
    // The lowest index wins, so the result does not depend on the order of threads.
    std::atomic<std::size_t> first = count;
    const auto check_part = [&](const tbb::blocked_range<std::size_t>& part) {
        for (std::size_t i = part.begin(); i < part.end() && i < first; ++i) {
            if (!is_faulty(i))
                continue;
            std::size_t before = first;
            while (i < before && !first.compare_exchange_weak(before, i)) {
            }
        }
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, task_objects), check_part);
    return first;
}

/// Whether an object's material has no fault if that of the other has none. False may be wrong.
bool shares_material(const Object& object, const Object& other)
{
    return !object.material.checker && object.material == other.material;
}

std::optional<SceneFault> fault_of_objects(const Scene& scene)
{
    const std::size_t first = first_faulty(scene.objects.size(), [&](std::size_t i) {
        const Object& object = scene.objects[i];
        if (fault_of_shape(object))
            return true;
        if (i > 0 && shares_material(object, scene.objects[i - 1]))
            return fault_of_names(object).has_value();
        return fault_of_looks(object, scene.illumination).has_value();
    });
    if (first == scene.objects.size())
        return std::nullopt;
    const OwnerFault fault = fault_of_object(scene.objects[first], scene.illumination);
    return SceneFault{subject_of(scene, first, *fault), fault->message, "objects", first,
                      fault->key};
}

std::optional<SceneFault> fault_of_lights(const Scene& scene)
{
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (OwnerFault fault = fault_in_rows(scene.lights[i]))
            return SceneFault{"light " + std::to_string(i + 1), fault->message, "lights", i};
    return std::nullopt;
}

}  // namespace

std::optional<SceneFault> fault_of_movement(const Scene& scene)
{
    if (!scene.animation)
        return std::nullopt;
    const Animation& animation = *scene.animation;
    if (const OwnerFault fault = fault_in_rows(animation))
        return SceneFault{"animation", fault->message};
    int earlier = -1;
    for (std::size_t i = 0; i < animation.keys.size(); ++i) {
        const CameraKey& key = animation.keys[i];
        if (const OwnerFault fault = fault_of_key(key, animation.frames, earlier))
            return SceneFault{"key " + std::to_string(i + 1), fault->message, "animation.keys", i};
        earlier = key.frame;
    }
    if (animation.orbit)
        if (const OwnerFault fault = fault_of_orbit(*animation.orbit, scene.camera))
            return SceneFault{"orbit", fault->message};
    if (const OwnerFault fault = fault_of_animation(animation))
        return SceneFault{"animation", fault->message};
    return std::nullopt;
}

namespace {

bool can_look(const Vec3& position, const Vec3& target, const Vec3& up)
{
    try {
        (void)look_at(position, target, up);
        return true;
    } catch (const std::invalid_argument&) {
        return false;
    }
}

}  // namespace

OwnerFault fault_of_surface(const Surface& surface, const Mat4& transform)
{
    if (const auto* const polygon = std::get_if<Polygon>(&surface))
        return fault_at("vertices", polygon_fault(*polygon));
    if (const auto* const quadric = std::get_if<Quadric>(&surface))
        return fault_at("coefficients", quadric_fault(*quadric, transform));
    return std::nullopt;
}

OwnerFault fault_of_shape(const Object& object)
{
    if (object.surface.valueless_by_exception())
        return KeyFault{"", "an exception left 'surface' without a value; assign it one"};
    OwnerFault fault =
        std::visit([](const auto& surface) { return fault_in_rows(surface); }, object.surface);
    if (!fault)
        fault = fault_of_surface(object.surface);
    if (!fault && object.transform != Mat4(1.0)) {
        fault = fault_at("matrix", fault_of_transform(object.transform));
        if (!fault)
            fault = fault_of_place(object.transform, object.surface);
        if (!fault && std::holds_alternative<Quadric>(object.surface))
            fault = fault_of_surface(object.surface, object.transform);
    }
    return fault;
}

OwnerFault fault_of_object(const Object& object, Illumination illumination)
{
    OwnerFault fault = fault_of_shape(object);
    return fault ? fault : fault_of_looks(object, illumination);
}

OwnerFault fault_of_camera(const Camera& camera)
{
    return fault_in_rows(keys_of_camera(camera));
}

OwnerFault fault_of_key(const CameraKey& key, int frames, int earlier)
{
    if (OwnerFault fault = fault_in_rows(key))
        return fault;
    if (Fault fault = language::fault_of("frame", key.frame,
                                         {.low = 0.0, .high = frames - 1.0, .whole = true}))
        return KeyFault{"frame", *std::move(fault)};
    if (!can_look(key.position, key.look_at, key.up))
        return KeyFault{"look_at", std::string(looks_nowhere)};
    if (key.frame <= earlier)
        return KeyFault{"", "frame " + std::to_string(key.frame) + " does not come after frame " +
                                std::to_string(earlier) +
                                " of the key before; write keys in rising order"};
    return std::nullopt;
}

OwnerFault fault_of_orbit(const Orbit& orbit, const Camera& camera)
{
    if (OwnerFault fault = fault_in_rows(orbit))
        return fault;
    const Vec3 arm = camera.position - orbit.center;
    if (arm == Vec3(0.0) ||
        glm::length(glm::cross(unit_vector(orbit.axis), unit_vector(arm))) < 1e-12)
        return KeyFault{"",
                        "the camera stands on the orbit's axis, where it would not move; give the "
                        "camera another position or the orbit another center"};
    return std::nullopt;
}

OwnerFault fault_of_animation(const Animation& animation)
{
    if (animation.orbit && !animation.keys.empty())
        return KeyFault{"",
                        "it has an orbit and keys, both of which move the camera; "
                        "remove one of them"};
    if (!animation.orbit && animation.keys.size() < 2)
        return KeyFault{"", "it moves nothing; add orbit { ... } or two or more key { ... }"};
    return std::nullopt;
}

std::optional<SceneFault> fault_of_shapes(const Scene& scene, std::span<const std::int32_t> objects,
                                          std::vector<MovedShape>& shapes)
{
    shapes.resize(objects.size());
    const auto number_at = [&](std::size_t i) { return static_cast<std::size_t>(objects[i]); };
    const std::size_t first = first_faulty(objects.size(), [&](std::size_t i) {
        const Object& object = scene.objects[number_at(i)];
        shapes[i] = moved_shape(object, objects[i]);
        return fault_of_shape(object).has_value();
    });
    if (first == objects.size())
        return std::nullopt;
    const std::size_t number = number_at(first);
    const OwnerFault fault = fault_of_shape(scene.objects[number]);
    return SceneFault{label_of(scene, number), fault->message, "objects", number, fault->key};
}

std::optional<SceneFault> fault_of_scene(const Scene& scene)
{
    if (const OwnerFault fault = fault_in_rows(scene))
        return SceneFault{"", fault->message};
    if (const OwnerFault fault = fault_of_camera(scene.camera))
        return SceneFault{"camera", fault->message};
    if (auto fault = fault_of_objects(scene))
        return fault;
    if (auto fault = fault_of_lights(scene))
        return fault;
    if (auto fault = fault_of_movement(scene))
        return fault;
    return fault_of_growth(scene);
}

}  // namespace packtrace::language

namespace packtrace {

void validate(const Scene& scene)
{
    if (auto fault = language::fault_of_scene(scene))
        throw language::SceneFaultError(*std::move(fault));
}

}  // namespace packtrace
