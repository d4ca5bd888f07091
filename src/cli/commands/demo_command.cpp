#include "cli/command.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/distinct_files.hpp"
#include "cli/output/text_table.hpp"
#include "core/atomic_file.hpp"
#include "core/check_number.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/harness/stopwatch.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/image.hpp>
#include <packtrace/image_io.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>
#include <packtrace/renderer.hpp>
#include <packtrace/scene.hpp>

#include <tbb/info.h>

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace packtrace::cli {
namespace {

struct DemoArguments {
    std::string scene;
    std::filesystem::path folder = "demo";
    PictureArguments picture{.size = "1024x1024", .depth = {}, .min_weight = {}};
    int threads = tbb::info::default_concurrency();
    int rounds = 5;
};

/// One way to render the demonstration's scene, and its result.
struct DemoEntry {
    bool packet = false;
    bool single = false;  ///< precision: single, otherwise double
    std::string isa;      ///< packets only
    int lanes = 1;
    int threads = 1;
    std::vector<double> seconds;  ///< one per round
    std::uint64_t rays = 0;       ///< camera, shadow and reflected rays of the packets' picture
    Image<double> image;
};

/// The scalar reference, then all instruction sets of this machine, in single and double with one
/// thread; then the widest single packets with `threads` threads, if that is more than one.
std::vector<DemoEntry> demo_entries(int threads)
{
    std::vector<DemoEntry> entries;
    for (const bool single : {false, true}) {
        DemoEntry entry;
        entry.single = single;
        entries.push_back(entry);
        entry.packet = true;
        for (const IsaInfo& isa : list_isas()) {
            entry.isa = isa.name;
            entry.lanes = single ? isa.lanes_single : isa.lanes_double;
            if (isa.supported)
                entries.push_back(entry);
        }
    }
    if (threads > 1 && entries.back().packet) {
        entries.push_back(entries.back());
        entries.back().threads = threads;
    }
    return entries;
}

template <class Real>
double render_packets(const Scene& scene, DemoEntry& entry)
{
    const Renderer<Real> renderer(scene, {.isa = entry.isa, .threads = entry.threads});
    Image<Real> image;
    // The first frame of a renderer allocates the memory that later frames reuse.
    entry.rays = renderer.render(image).total();
    const double seconds =
        seconds_of(entry.threads, [&] { static_cast<void>(renderer.render(image)); });
    entry.image = convert<double>(image);
    return seconds;
}

template <class Real>
double render_scalar(const Scene& scene, DemoEntry& entry)
{
    const RenderOptions options{.kernel = Kernel::scalar, .threads = entry.threads};
    Image<Real> image;
    const double seconds = seconds_of(entry.threads, [&] { image = render<Real>(scene, options); });
    entry.image = convert<double>(image);
    return seconds;
}

/// Renders the scene once more and keeps the picture. Returns the seconds.
double render_entry(const Scene& scene, DemoEntry& entry)
{
    if (entry.packet)
        return entry.single ? render_packets<float>(scene, entry)
                            : render_packets<double>(scene, entry);
    return entry.single ? render_scalar<float>(scene, entry) : render_scalar<double>(scene, entry);
}

void render_rounds(const Scene& scene, int rounds, std::vector<DemoEntry>& entries)
{
    auto seconds = time_in_turns(entries.size(), rounds,
                                 [&](std::size_t i) { return render_entry(scene, entries[i]); });
    for (std::size_t i = 0; i < entries.size(); ++i)
        entries[i].seconds = std::move(seconds[i]);
    // The reference traces the same rays as the packets, but does not count them.
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
            brief(error.max_abs, 2),
            brief(error.rmse, 2),
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

/// Splits the speed-up of the widest packets over the reference into algorithm and SIMD: the
/// kernels with one lane have the algorithm without SIMD.
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

/// The pictures in the output folder.
struct DemoPictures {
    std::filesystem::path folder;
    std::filesystem::path picture;
    std::filesystem::path error;

    DemoPictures(const std::filesystem::path& into, const std::string& stem)
        : folder(into), picture(into / (stem + ".png")), error(into / (stem + "_error.png"))
    {
    }

    /// Throws FileError if they cannot be written, or would replace the scene.
    void check(const std::string& scene) const
    {
        check_folder(folder);
        std::error_code ignored;
        if (!std::filesystem::exists(folder, ignored))
            return;
        for (const std::filesystem::path& file : {picture, error}) {
            check_not_read(file.string(), {scene});
            check_image_writable(file);
        }
    }

    void write(const std::vector<DemoEntry>& entries) const
    {
        make_folders(folder);
        write_image(picture, convert<float>(entries.back().image));
        std::cout << "picture           " << language::escape(picture.string()) << '\n';
        write_image(error, heatmap(entries.back().image, entries.front().image));
        std::cout << "its error         " << language::escape(error.string()) << '\n';
    }
};

/// The scene in the present folder or, if there is none, the installed one.
std::string default_scene()
{
    const std::filesystem::path scene = "scenes/four_spheres.scene";
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path installed =
        program.parent_path().parent_path() / "share" / "packtrace" / scene;
    return !std::filesystem::exists(scene, error) && std::filesystem::exists(installed, error)
               ? installed.string()
               : scene.string();
}

void run_demo(const DemoArguments& arguments)
{
    const std::string file = arguments.scene.empty() ? default_scene() : arguments.scene;
    SceneInput input = read_scene_input(file);
    Scene& scene = input.scene;
    apply(arguments.picture, scene);
    const DemoPictures pictures(arguments.folder, input.stem);
    pictures.check(file);

    limit_threads(arguments.threads);
    std::vector<DemoEntry> entries = demo_entries(arguments.threads);
    render_rounds(scene, arguments.rounds, entries);
    std::cout << language::escape(input.name) << ", " << scene.width << " x " << scene.height
              << ", median of " << counted(arguments.rounds, "render")
              << "; errors against the scalar reference in double\n\n";
    print_table(entries);
    std::cout << '\n';
    print_split(entries);
    std::cout << '\n';
    pictures.write(entries);
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
        ->check(file_name())
        ->type_name("");
    command->add_option("-o,--output", arguments->folder, "Folder for the pictures (default demo)")
        ->check(folder_name())
        ->type_name("DIR");
    add_picture_options(*command, arguments->picture);
    add_threads_option(*command, arguments->threads);
    command
        ->add_option("--rounds", arguments->rounds,
                     "How often to render with each kernel (default 5)")
        ->check(whole_number(1, most_repetitions))
        ->type_name("N");
    command->callback([arguments] { run_demo(*arguments); });
}

}  // namespace packtrace::cli
