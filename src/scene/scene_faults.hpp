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

// What is wrong with scenes: values by the rows of their keys, and whatever takes more than one
// value to see. The reader asks for its objects as it reads them, validate() for all.
namespace packtrace::language {

/// A fault of a surface that its keys by themselves don't have: a polygon that is not flat, a
/// quadric without a surface.
[[nodiscard]] OwnerFault fault_of_surface(const Surface& surface,
                                          const Mat4& transform = Mat4(1.0));

/// The first fault of an object's surface and of its transform.
[[nodiscard]] OwnerFault fault_of_shape(const Object& object);

/// The first fault of an object but for its name's being another's.
[[nodiscard]] OwnerFault fault_of_object(const Object& object, Illumination illumination);

[[nodiscard]] OwnerFault fault_of_camera(const Camera& camera);

/// A key of an animation that has these frames, after a key at frame `earlier` (-1 for none).
[[nodiscard]] OwnerFault fault_of_key(const CameraKey& key, int frames, int earlier);
[[nodiscard]] OwnerFault fault_of_orbit(const Orbit& orbit, const Camera& camera);
/// Its frames, and whether it moves the camera one way.
[[nodiscard]] OwnerFault fault_of_animation(const Animation& animation);

struct SceneFault {
    std::string subject;  ///< "sphere 3", "light 1", "camera"; empty for the scene's own keys
    std::string message;
    std::string_view list{};  ///< the scene's list that holds the subject, as code calls it, if any
    std::size_t index{};      ///< there
    std::string_view key{};   ///< of an object

    [[nodiscard]] std::string text() const
    {
        return subject.empty() ? message : subject + ": " + message;
    }
    /// For who made the scene in code: by the place in the list, "lights[0]", not by a number
    /// from 1.
    [[nodiscard]] std::string text_by_index() const
    {
        if (list.empty())
            return text();
        // A name of the user's own stands in quotes.
        const std::string name = subject.ends_with('\'') ? ": " + subject : std::string();
        return std::string(list) + "[" + std::to_string(index) + "]" + name + ": " + message;
    }
};

/// The SceneError of a scene that was made in code.
struct SceneFaultError final : SceneError {
    explicit SceneFaultError(SceneFault found) : SceneError(found.text()), fault(std::move(found))
    {
    }

    SceneFault fault;
};

/// The first fault of a scene's animation, if it has one.
[[nodiscard]] std::optional<SceneFault> fault_of_movement(const Scene& scene);

/// The first fault of a scene, in the order in which it is read: its own keys, camera, objects,
/// lights, animation; then what needs all of them.
[[nodiscard]] std::optional<SceneFault> fault_of_scene(const Scene& scene);

/// The first of the objects numbered whose surface or transform has a fault. Without a fault
/// `shapes` holds them.
[[nodiscard]] std::optional<SceneFault> fault_of_shapes(const Scene& scene,
                                                        std::span<const std::int32_t> objects,
                                                        std::vector<MovedShape>& shapes);

/// Colours that may grow beyond single precision. Nothing where none can, which no factor at or
/// below 1 in sum can make it.
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
