#pragma once

#include "catch.hpp"
#include "refusal.hpp"
#include <packtrace/read_scene.hpp>

#include <fstream>
#include <string>
#include <vector>

// Helpers for the tests of the scene reader.
namespace packtrace::test {

inline Scene parse(const std::string& text)
{
    return parse_scene(text, "x.scene");
}

/// The error message for a refused `text`.
inline std::string error_of(const std::string& text)
{
    return refusal<SceneError>([&] { return parse(text); });
}

inline const char* const any_sphere = "sphere { center = (0, 0, 3) radius = 1 }\n";

/// A scene of `text` and a visible sphere.
inline Scene parse_with_sphere(const std::string& text)
{
    return parse(any_sphere + text);
}

/// The error of a scene whose second line is `line`.
inline std::string error_of_line(const std::string& line)
{
    return error_of(any_sphere + line);
}

/// The example scenes in docs/scene.md.
inline std::vector<std::string> scene_examples()
{
    std::ifstream reference(PACKTRACE_SOURCE_DIR "/docs/scene.md");
    std::vector<std::string> examples;
    for (std::string line; std::getline(reference, line);) {
        if (line != "```scene")
            continue;
        examples.emplace_back();
        while (std::getline(reference, line) && line != "```")
            examples.back() += line + '\n';
    }
    return examples;
}

}  // namespace packtrace::test
