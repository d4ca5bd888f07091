#pragma once

#include "cli/options/validators.hpp"
#include "core/read_file.hpp"
#include "scene/language/source.hpp"
#include <packtrace/read_scene.hpp>
#include <packtrace/scene.hpp>

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>

namespace packtrace::cli {

/// A scene from the command line: a file, or - for standard input.
struct SceneInput {
    std::string name;  ///< for messages and tables
    std::string stem;  ///< for the names of its output files
    std::string text;
    Scene scene;
};

/// The name of a scene in messages and tables.
[[nodiscard]] inline std::string scene_name(const std::string& file)
{
    return file == "-" ? "standard input" : file;
}

/// The name for a scene's output files.
[[nodiscard]] inline std::string scene_stem(const std::string& file)
{
    return file == "-" ? "stdin" : std::filesystem::path(file).stem().string();
}

/// Throws SceneError: standard input was already read for another scene.
[[noreturn]] inline void fail_read_already()
{
    throw SceneError(scene_name("-") + ": has been read already; give - for one scene only");
}

/// A name for a scene that is not in `taken`. Adds it to `taken`.
[[nodiscard]] inline std::string free_scene_name(const std::string& stem,
                                                 std::set<std::string>& taken)
{
    std::string name = stem;
    for (int number = 2; !taken.insert(name).second; ++number)
        name = stem + "_" + std::to_string(number);
    return name;
}

/// Adds the required positional argument SCENE.
inline CLI::Option* add_scene_option(CLI::App& command, std::string& file)
{
    return command.add_option("SCENE", file, "Scene file; - is standard input")
        ->required()
        ->check(file_name())
        ->type_name("");
}

/// Reads a scene and prints warnings on standard error. Throws SceneError, also if standard input
/// was read before, and FileError if standard input cannot be read.
[[nodiscard]] inline SceneInput read_scene_input(const std::string& file)
{
    const bool piped = file == "-";
    SceneInput input;
    input.name = scene_name(file);
    input.stem = scene_stem(file);
    if (piped && std::cin.eof())
        fail_read_already();
    input.text = piped ? language::load_text(std::cin, input.name) : language::load_text(file);
    // std::cin reads through the C library and does not report its read errors.
    if (piped && std::ferror(stdin) != 0)
        throw FileError(input.name, FileAction::read, errno);
    input.scene = parse_scene(input.text, input.name, [](const std::string& line) {
        std::cerr << "warning: " << line << '\n';
    });
    return input;
}

}  // namespace packtrace::cli
