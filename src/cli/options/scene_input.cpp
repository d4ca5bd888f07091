#include "cli/options/scene_input.hpp"

#include <filesystem>
#include <iostream>

#include <packtrace/read_scene.hpp>

#include "scene/source.hpp"

namespace packtrace::cli {
namespace {

constexpr const char* standard_input = "standard input";

std::string read_standard_input()
{
    if (std::cin.eof())
        throw SceneError(std::string(standard_input) +
                         ": has been read already; give - for one scene only");
    return language::load_text(std::cin, standard_input);
}

}  // namespace

CLI::Option* add_scene_option(CLI::App& command, std::string& file)
{
    return command.add_option("SCENE", file, "Scene file; - is standard input")
        ->required()
        ->type_name("");
}

SceneInput read_scene_input(const std::string& file)
{
    const bool piped = file == "-";
    SceneInput input;
    input.name = piped ? standard_input : file;
    input.stem = piped ? "stdin" : std::filesystem::path(file).stem().string();
    input.text = piped ? read_standard_input() : language::load_text(file);
    input.scene = parse_scene(input.text, input.name, [](const std::string& line) {
        std::cerr << "warning: " << line << '\n';
    });
    return input;
}

}  // namespace packtrace::cli
