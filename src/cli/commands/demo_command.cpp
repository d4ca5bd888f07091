#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <packtrace/compare.hpp>
#include <packtrace/image_io.hpp>

#include <tbb/info.h>

#include "cli/command.hpp"
#include "cli/commands/demo_entry.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/text_table.hpp"
#include "core/atomic_file.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/harness/stopwatch.hpp"
#include "scene/quote.hpp"

namespace packtrace::cli {
namespace {

struct DemoArguments {
    std::string scene = "scenes/four_spheres.scene";
    std::filesystem::path folder = "demo";
    PictureArguments picture{.size = "1024x1024", .depth = {}, .min_weight = {}};
    int threads = tbb::info::default_concurrency();
    int rounds = 5;
};

void render_rounds(const Scene& scene, int rounds, std::vector<DemoEntry>& entries)
{
    auto seconds = time_in_turns(entries.size(), rounds,
                                 [&](std::size_t i) { return render_entry(scene, entries[i]); });
    for (std::size_t i = 0; i < entries.size(); ++i)
        entries[i].seconds = std::move(seconds[i]);
    // The reference traces the packets' rays, but does not count them.
    for (DemoEntry& entry : entries)
        entry.rays = entry.packet ? entry.rays : entries[1].rays;
}

// The scalar entry of the same precision.
const DemoEntry& scalar_of(const DemoEntry& entry, const std::vector<DemoEntry>& entries)
{
    for (const DemoEntry& other : entries)
        if (!other.packet && other.single == entry.single)
            return other;
    return entries.front();
}

std::vector<std::string> table_row(const DemoEntry& entry, const std::vector<DemoEntry>& entries)
{
    const double seconds = median_of(entry.seconds);
    // The first entry is the truth: the reference in double.
    const Comparison error = compare(entry.image, entries.front().image);
    return {entry.packet ? "packet" : "scalar",
            entry.single ? "single" : "double",
            entry.packet ? entry.isa : "-",
            std::to_string(entry.lanes),
            std::to_string(entry.threads),
            fixed(1e3 * seconds, 2),
            fixed(1e-6 * static_cast<double>(entry.rays) / seconds, 1),
            fixed(median_of(scalar_of(entry, entries).seconds) / seconds, 2),
            brief(error.max_abs),
            brief(error.rmse),
            std::to_string(error.pixels_off)};
}

void print_table(const std::vector<DemoEntry>& entries)
{
    TextTable table(3, {"kernel", "precision", "ISA", "lanes", "threads", "ms", "Mrays/s",
                        "speed-up", "max error", "RMS error", "pixels off"});
    for (const DemoEntry& entry : entries)
        table.add(table_row(entry, entries));
    table.print(std::cout);
}

/// What the widest packets gain over the reference, told apart: the same kernels one lane at a time
/// have the algorithm and no SIMD.
void print_split(const std::vector<DemoEntry>& entries)
{
    for (const bool single : {false, true}) {
        const DemoEntry* one = nullptr;
        const DemoEntry* widest = nullptr;
        for (const DemoEntry& entry : entries) {
            if (!entry.packet || entry.single != single || entry.threads != 1)
                continue;
            widest = &entry;
            if (entry.lanes == 1)
                one = &entry;
        }
        if (one == nullptr || widest == one)
            continue;
        const double alone = median_of(one->seconds);
        const double all = median_of(widest->seconds);
        std::cout << (single ? "single" : "double") << ": " << widest->lanes << " lanes are "
                  << fixed(alone / all, 2)
                  << " times as fast as the same kernels with one, which are "
                  << fixed(median_of(scalar_of(*one, entries).seconds) / alone, 2)
                  << " times as fast as the reference\n";
    }
}

void write_pictures(const std::filesystem::path& folder, const std::string& stem,
                    const std::vector<DemoEntry>& entries)
{
    const std::filesystem::path file = folder / (stem + ".png");
    write_image(file, convert<float>(entries.back().image));
    std::cout << "picture           " << language::escape(file.string()) << '\n';
    const std::filesystem::path map = folder / (stem + "_error.png");
    write_image(map, heatmap(entries.back().image, entries.front().image));
    std::cout << "its error         " << language::escape(map.string()) << '\n';
}

void run_demo(const DemoArguments& arguments)
{
    SceneInput input = read_scene_input(arguments.scene);
    Scene& scene = input.scene;
    apply(arguments.picture, scene);
    make_folders(arguments.folder);
    check_image_writable(arguments.folder / (input.stem + ".png"));

    const ThreadLimit limit(arguments.threads);
    std::vector<DemoEntry> entries = demo_entries(arguments.threads);
    render_rounds(scene, arguments.rounds, entries);
    std::cout << language::escape(input.name) << ", " << scene.width << " x " << scene.height
              << ", median of " << arguments.rounds
              << " renders; errors against the scalar reference in double\n\n";
    print_table(entries);
    std::cout << '\n';
    print_split(entries);
    std::cout << '\n';
    write_pictures(arguments.folder, input.stem, entries);
}

}  // namespace

void add_demo(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "demo", "Render a scene with every kernel; print speed and error of each");
    const auto arguments = std::make_shared<DemoArguments>();
    command
        ->add_option("SCENE", arguments->scene,
                     "Scene file (default scenes/four_spheres.scene); - is standard input")
        ->type_name("");
    command->add_option("-o,--output", arguments->folder, "Folder for the pictures (default demo)")
        ->type_name("DIR");
    add_picture_options(*command, arguments->picture);
    add_threads_option(*command, arguments->threads);
    command
        ->add_option("--rounds", arguments->rounds,
                     "How often to render with each kernel (default 5)")
        ->check(whole_number(1, 1000))
        ->type_name("N");
    command->callback([arguments] { run_demo(*arguments); });
}

}  // namespace packtrace::cli
