// packtrace_sorted: frames of large scenes with mirrors on one thread, in blocks of tiles with
// sorted mirrored rays against tile by tile; as JSON.
#include "context.hpp"
#include "dispatch/kernels.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/harness/stopwatch.hpp"
#include "program.hpp"
#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/renderer.hpp>

#include <nlohmann/json.hpp>

#include <iostream>
#include <string>
#include <vector>

namespace packtrace {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::vector<std::string> isas{"avx512", "avx2"};
    int size = 1024;
    int repetitions = 9;
};

Scene flake(int depth)
{
    return generate_sphereflake({.depth = depth, .reflective = 0.5, .ground = true});
}

Scene random_mirrors(int count, double radius)
{
    return generate_random_spheres({.count = count, .radius = radius, .reflective = 0.5});
}

struct NamedScene {
    std::string name;
    Scene scene;
};

std::vector<NamedScene> large_scenes()
{
    return {{"flake4", flake(4)},
            {"flake5", flake(5)},
            {"flake6", flake(6)},
            {"random1000", random_mirrors(1'000, 0.05)},
            {"random100k", random_mirrors(100'000, 0.005)}};
}

/// Edges of the blocks that are rendered at once, in tiles.
constexpr int edges[] = {1, abi::block_edge / 2, abi::block_edge};

Json race(const NamedScene& named, const std::string& isa, const Arguments& arguments)
{
    Scene scene = named.scene;
    scene.width = scene.height = arguments.size;
    const TileRenderer<float> tiles(scene, lower(scene), kernels_of(isa), {});
    Image<float> image(scene.width, scene.height);
    const auto frame = [&](std::size_t i) {
        const TileGrid grid({0, 0, scene.width, scene.height}, edges[i] * abi::tile_size);
        return seconds_of(1, [&] {
            for (int piece = 0; piece < grid.count(); ++piece)
                (void)tiles.render_once(image, grid[piece]);
        });
    };
    // The first frames allocate memory.
    (void)time_in_turns(std::size(edges), 1, frame);
    const auto seconds = time_in_turns(std::size(edges), arguments.repetitions, frame);
    Json json{{"scene", named.name}, {"isa", isa}};
    for (std::size_t i = 0; i < std::size(edges); ++i) {
        std::vector<double> faster;
        for (std::size_t turn = 0; turn < seconds[i].size(); ++turn)
            faster.push_back(seconds[0][turn] / seconds[i][turn]);
        json["blocks"].push_back({{"tiles", edges[i] * edges[i]},
                                  {"ms", 1e3 * median_of(seconds[i])},
                                  {"times_as_fast", median_of(faster)},
                                  {"lowest", quantile(faster, 0.0)},
                                  {"highest", quantile(faster, 1.0)}});
    }
    return json;
}

void print_report(const Arguments& arguments, const std::string& command)
{
    Json report{{"program", "packtrace_sorted"}, {"command", command}};
    report["context"] = bench::context_json();
    report["size"] = arguments.size;
    report["repetitions"] = arguments.repetitions;
    report["frames"] = Json::array();
    for (const NamedScene& named : large_scenes())
        for (const std::string& isa : arguments.isas)
            report["frames"].push_back(race(named, isa, arguments));
    bench::add_load_after(report["context"]);
    std::cout << report.dump(2) << '\n';
}

}  // namespace
}  // namespace packtrace

int main(int argc, char** argv)
{
    packtrace::Arguments arguments;
    packtrace::bench::Program program(
        "packtrace_sorted", "Frames with sorted mirrored rays against tile by tile, as JSON");
    program.words("--isa", arguments.isas, "Instruction sets (default avx512,avx2)");
    program.number("--size", arguments.size, {16, 4096}, "Pixels of each edge (default 1024)");
    program.number("--repetitions", arguments.repetitions, {1, 1000}, "Turns (default 9)");
    return program.run(argc, argv,
                       [&] { packtrace::print_report(arguments, program.command_line()); });
}
