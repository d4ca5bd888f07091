#pragma once

#include <string>

#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

namespace packtrace::cli {

/// A scene as a command line names it: a file, or - for standard input.
struct SceneInput {
    std::string name;  ///< for messages and tables
    std::string stem;  ///< for the names of files made of it
    std::string text;
    Scene scene;
};

/// Adds the positional SCENE, which is required.
CLI::Option* add_scene_option(CLI::App& command, std::string& file);

/// Reads it; warnings go to standard error. Throws SceneError, also where standard input has been
/// read before.
[[nodiscard]] SceneInput read_scene_input(const std::string& file);

}  // namespace packtrace::cli
