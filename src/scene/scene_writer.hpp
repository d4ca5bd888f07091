#pragma once

#include <cstddef>
#include <string>

#include <packtrace/scene.hpp>

namespace packtrace::language {

/// A scene's text, and how many keys it has.
struct SceneText {
    std::string text;
    std::size_t keys = 0;
};

/// The text of a scene, whatever faults it has; one without reads back as the same.
[[nodiscard]] SceneText write_unchecked(const Scene& scene);

}  // namespace packtrace::language
