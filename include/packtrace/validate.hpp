#pragma once

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

#include <stdexcept>

namespace packtrace {

/// A scene that can't be used. `what()` is one line, `what, why, what to do`, that begins with what
/// it is about ("sphere 3: 'radius' is -1; use a number above 0"). A reader puts
/// `file:line:column: ` in front.
struct PACKTRACE_API SceneError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Throws SceneError for the first fault of a scene: a number that is not finite or out of its
/// key's range (docs/scene.md), an object without a surface, a material of another illumination
/// model, a name that no scene file can hold. Keys are named as in the scene language: a fault of
/// `Object::transform` is one of 'matrix'.
///
/// read_scene(), render(), Renderer, RayScene and scene_text() call it, so that all refuse the same
/// scenes with the same words. The text of what passes reads back as the same scene. Works on the
/// threads of the TBB arena the call runs in, and allocates nothing for an object without a fault.
PACKTRACE_API void validate(const Scene& scene);

}  // namespace packtrace
