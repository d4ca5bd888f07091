// packtrace_frames: writes a scene for another tracer, or times packtrace's frames of a scene.
#include "context.hpp"
#include "core/atomic_file.hpp"
#include "core/seconds_since.hpp"
#include "export.hpp"
#include "program.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/renderer.hpp>

#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>

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

/// Prints the seconds of reading, of preparing, and of each frame (a float picture).
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

}  // namespace
}  // namespace packtrace::peers

int main(int argc, char** argv)
{
    using namespace packtrace::peers;
    packtrace::bench::Program program(
        "packtrace_frames", "Writes scenes for other tracers, and times packtrace's frames");
    ExportArguments exported;
    auto& to = program.command("export", "Write a scene for another tracer",
                               [&] { export_scene(exported.scene, exported.output); });
    to.text("SCENE", exported.scene, "Scene file");
    to.text("-o,--output", exported.output, "A .pov or .dat file",
            packtrace::bench::Need::required);

    RenderArguments rendered;
    auto& render =
        program.command("render", "Time frames; prints JSON", [&] { render_frames(rendered); });
    render.text("SCENE", rendered.scene, "Scene file");
    render.text("-o,--output", rendered.picture, "Write the last picture");
    render.number("--threads", rendered.threads, {1, 1024}, "Threads (default 1)");
    render.number("--frames", rendered.frames, {1, 1000}, "How many frames (default 3)");
    render.number("--size", rendered.size, {1, 65536}, "Pixels of each edge (default the scene's)");

    program.command("context", "Print machine, compiler and commit", print_context);
    return program.run(argc, argv);
}
