#pragma once

#include <packtrace/export.hpp>
#include <packtrace/scene.hpp>

#include <stdexcept>

namespace packtrace {

/// A scene that cannot be used. `what()` is one line, `what, why, what to do`, and begins with the
/// object and key ("sphere 3: 'radius' is -1; use a number above 0"). Readers of scene files
/// prepend `file:line:column: `.
struct PACKTRACE_API SceneError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Throws SceneError for the first fault of a scene: a number that is not finite or not in its
/// key's range (docs/scene.md), an object without a surface, a material of another illumination
/// model, a name that a scene file cannot hold. Messages use the key names of the scene language: a
/// fault of `Object::transform` is reported for 'matrix'.
///
/// read_scene(), render(), Renderer, RayScene and scene_text() call validate(), so all of them
/// reject the same scenes with the same messages. The text of a valid scene reads back as the same
/// scene. Uses the threads of the TBB arena of the caller. Does not allocate for objects without a
/// fault.
PACKTRACE_API void validate(const Scene& scene);

}  // namespace packtrace
