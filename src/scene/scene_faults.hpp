#pragma once

#include "scene/language/rows.hpp"
#include "scene/moved_shape.hpp"
#include <packtrace/scene.hpp>
#include <packtrace/validate.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Faults of scenes: of single values, by the rows of their keys, and of several values together.
// The reader checks each object when it reads it; validate() checks the whole scene.
namespace packtrace::language {

/// The fault of a surface whose keys are valid one by one: a polygon that is not flat, a quadric
/// without a surface.
[[nodiscard]] OwnerFault fault_of_surface(const Surface& surface,
                                          const Mat4& transform = Mat4(1.0));

/// The first fault of an object's surface and of its transform.
[[nodiscard]] OwnerFault fault_of_shape(const Object& object);

/// The first fault of an object. Duplicate names are not checked.
[[nodiscard]] OwnerFault fault_of_object(const Object& object, Illumination illumination);

[[nodiscard]] OwnerFault fault_of_camera(const Camera& camera);

/// The fault of a key in an animation of `frames` frames. The key before it is at frame `earlier`,
/// -1 for none.
[[nodiscard]] OwnerFault fault_of_key(const CameraKey& key, int frames, int earlier);
[[nodiscard]] OwnerFault fault_of_orbit(const Orbit& orbit, const Camera& camera);
/// The fault of an animation that does not have either an orbit or at least two keys.
[[nodiscard]] OwnerFault fault_of_animation(const Animation& animation);

struct SceneFault {
    std::string subject;  ///< "sphere 3", "light 1", "camera"; empty for the scene's own keys
    std::string message;
    std::string_view list{};  ///< the member of Scene with the subject: "lights"; may be empty
    std::size_t index{};      ///< of the subject in `list`
    std::string_view key{};   ///< of an object

    [[nodiscard]] std::string text() const
    {
        return subject.empty() ? message : subject + ": " + message;
    }
    /// For users who built the scene in code. It names the subject by its index in the list,
    /// "lights[0]", not by a number from 1.
    [[nodiscard]] std::string text_by_index() const
    {
        if (list.empty())
            return text();
        // Only the user's own names are in quotes.
        const std::string name = subject.ends_with('\'') ? ": " + subject : std::string();
        return std::string(list) + "[" + std::to_string(index) + "]" + name + ": " + message;
    }
};

/// The SceneError of a scene that was built in code.
struct SceneFaultError final : SceneError {
    explicit SceneFaultError(SceneFault found) : SceneError(found.text()), fault(std::move(found))
    {
    }

    SceneFault fault;
};

/// The first fault of a scene's animation, if it has one.
[[nodiscard]] std::optional<SceneFault> fault_of_movement(const Scene& scene);

/// The first fault of a scene, in the order in which it is read: its own keys, camera, objects,
/// lights, animation, then faults that depend on all of them.
[[nodiscard]] std::optional<SceneFault> fault_of_scene(const Scene& scene);

/// The first fault of the surface or the transform of one of `objects`, which are indices. If there
/// is none, `shapes` receives these objects.
[[nodiscard]] std::optional<SceneFault> fault_of_shapes(const Scene& scene,
                                                        std::span<const std::int32_t> objects,
                                                        std::vector<MovedShape>& shapes);

/// The fault of a scene whose colours may grow beyond single precision. There is none if the
/// factors of every material add up to at most 1.
[[nodiscard]] std::optional<SceneFault> fault_of_growth(const Scene& scene);

inline constexpr std::string_view looks_nowhere =
    "'look_at' is the camera's own position or straight along 'up'; move one of them or give "
    "another up";
inline constexpr std::string_view checker_of_no_plane =
    "only a plane can have a checker; remove it and use color";
inline constexpr std::string_view checker_without_color =
    "'checker' has no effect under illumination = general, whose coefficients know no colour; "
    "remove it";

}  // namespace packtrace::language
