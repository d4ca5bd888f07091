// packtrace_frames: writes a scene for another tracer, or times packtrace's frames of it.
#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <packtrace/image_io.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/renderer.hpp>

#include "context.hpp"
#include "core/atomic_file.hpp"
#include "core/seconds_since.hpp"
#include "export.hpp"
#include "program.hpp"

namespace packtrace::peers {
namespace {

void export_scene(const std::string& from, const std::filesystem::path& to)
{
    const Scene scene = read_scene(from);
    AtomicFile file(to);
    if (to.extension() == ".pov")
        file.write(pov_scene(scene));
    else if (to.extension() == ".dat")
        file.write(tachyon_scene(scene));
    else
        throw std::runtime_error(to.string() + ": write a .pov (POV-Ray) or .dat (Tachyon)");
    file.commit();
}

struct RenderArguments {
    std::string scene;
    std::string picture;
    int threads = 1;
    int frames = 3;
    int size = 0;
};

/// Prints seconds of reading, of preparing, and of each frame up to its float picture.
void render_frames(const RenderArguments& arguments)
{
    nlohmann::ordered_json report;
    auto start = std::chrono::steady_clock::now();
    Scene scene = read_scene(arguments.scene);
    report["read_seconds"] = seconds_since(start);
    if (arguments.size > 0)
        scene.width = scene.height = arguments.size;
    const RenderOptions options{.threads = arguments.threads};
    start = std::chrono::steady_clock::now();
    const Renderer<float> renderer(scene, options);
    report["prepare_seconds"] = seconds_since(start);
    Image<float> image;
    for (int frame = 0; frame < arguments.frames; ++frame) {
        start = std::chrono::steady_clock::now();
        const auto rays = renderer.render(image);
        report["frame_seconds"].push_back(seconds_since(start));
        report["rays"] = rays.total();
    }
    if (!arguments.picture.empty())
        write_image(arguments.picture, image);
    std::cout << report.dump() << '\n';
}

void print_context()
{
    std::cout << bench::context_json().dump() << '\n';
}

struct ExportArguments {
    std::string scene;
    std::string output;
};

void add_commands(CLI::App& app, ExportArguments& exported, RenderArguments& rendered)
{
    app.require_subcommand(1);
    CLI::App* to = app.add_subcommand("export", "Write a scene for another tracer");
    to->add_option("SCENE", exported.scene, "Scene file")->required();
    to->add_option("-o,--output", exported.output, "A .pov or .dat file")->required();
    to->callback([&] { export_scene(exported.scene, exported.output); });

    CLI::App* render = app.add_subcommand("render", "Time frames; prints JSON");
    render->add_option("SCENE", rendered.scene, "Scene file")->required();
    render->add_option("-o,--output", rendered.picture, "Write the last picture");
    render->add_option("--threads", rendered.threads, "Threads (default 1)")
        ->check(CLI::Range(1, 1024));
    render->add_option("--frames", rendered.frames, "How many frames (default 3)")
        ->check(CLI::Range(1, 1000));
    render->add_option("--size", rendered.size, "Pixels of each edge (default the scene's)")
        ->check(CLI::Range(1, 65536));
    render->callback([&] { render_frames(rendered); });

    CLI::App* context = app.add_subcommand("context", "Print machine, compiler and commit");
    context->callback(print_context);
}

}  // namespace
}  // namespace packtrace::peers

int main(int argc, char** argv)
{
    using namespace packtrace::peers;
    CLI::App app{"Writes scenes for other tracers, and times packtrace's frames"};
    ExportArguments exported;
    RenderArguments rendered;
    add_commands(app, exported, rendered);
    // The commands' callbacks do the work.
    return packtrace::bench::run_program(app, "packtrace_frames", argc, argv, [] {});
}
