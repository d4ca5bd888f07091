// What special kernels save: frames by each scene's special kernel and by the general one, by turns
// on one thread.
#include "core/atomic_file.hpp"
#include "dispatch/kernels.hpp"
#include "lab/harness/machine.hpp"
#include "lab/harness/statistics.hpp"
#include "lower/prune.hpp"
#include "program.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/renderer.hpp>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace packtrace;
using Json = nlohmann::ordered_json;

struct Arguments {
    std::vector<std::string> scenes;
    std::string isa = "auto";
    std::string json;
    int size = 512;
    int repetitions = 15;
};

/// Frames are repeated for this many seconds, so that the clock is exact enough.
constexpr double least_seconds = 0.05;

enum class Chosen { special, general };

/// A scene with one kernel, and the times of its frames.
class Frames {
public:
    Frames(const Scene& scene, const std::string& isa, Chosen kernel)
        : renderer_(scene, options_of(isa, kernel))
    {
        (void)renderer_.render(image_);
    }

    /// Adds the mean time of some frames.
    void time()
    {
        using Clock = std::chrono::steady_clock;
        const auto start = Clock::now();
        double seconds = 0.0;
        int frames = 0;
        for (; seconds < least_seconds; ++frames) {
            (void)renderer_.render(image_);
            seconds = std::chrono::duration<double>(Clock::now() - start).count();
        }
        milliseconds_.push_back(1e3 * seconds / frames);
    }

    [[nodiscard]] const std::vector<double>& milliseconds() const
    {
        return milliseconds_;
    }
    [[nodiscard]] bool same_bits(const Frames& other) const
    {
        return std::memcmp(image_.rgb.data(), other.image_.rgb.data(),
                           image_.rgb.size() * sizeof(float)) == 0;
    }

private:
    static RenderOptions options_of(const std::string& isa, Chosen kernel)
    {
        return {.isa = isa, .force_general = kernel == Chosen::general, .threads = 1};
    }

    Renderer<float> renderer_;
    Image<float> image_;
    std::vector<double> milliseconds_;
};

std::string kernel_name(const Scene& scene, const std::string& isa)
{
    LoweredScene lowered = lower(scene);
    prune(lowered);
    return kernels_for(precision<float>(kernels_of(isa)), lowered.features).set.name;
}

Json measure(const std::string& file, const Arguments& arguments, const std::string& isa)
{
    Scene scene = read_scene(file);
    scene.width = scene.height = arguments.size;
    Frames special(scene, isa, Chosen::special);
    Frames general(scene, isa, Chosen::general);
    for (int i = 0; i < arguments.repetitions; ++i) {
        special.time();
        general.time();
    }
    std::vector<double> ratios;
    for (std::size_t i = 0; i < special.milliseconds().size(); ++i)
        ratios.push_back(general.milliseconds()[i] / special.milliseconds()[i]);
    return {{"scene", std::filesystem::path(file).stem().string()},
            {"kernel", kernel_name(scene, isa)},
            {"special_ms", median_of(special.milliseconds())},
            {"general_ms", median_of(general.milliseconds())},
            {"general_over_special", median_of(ratios)},
            {"spread", relative_spread(ratios)},
            {"same_bits", special.same_bits(general)}};
}

void print(const Json& row)
{
    std::printf("%-22s %-9s %9.3f %9.3f %7.2f %6.1f%%  %s\n",
                row["scene"].get<std::string>().c_str(), row["kernel"].get<std::string>().c_str(),
                row["special_ms"].get<double>(), row["general_ms"].get<double>(),
                row["general_over_special"].get<double>(), 100.0 * row["spread"].get<double>(),
                row["same_bits"].get<bool>() ? "same bits" : "OTHER BITS");
    std::fflush(stdout);
}

/// Throws if a scene's two pictures differ.
void run(const Arguments& arguments)
{
    const std::string isa = choose_isa(arguments.isa).name;
    Json report{{"machine", processor_name()}, {"compiler", compiler_name()},
                {"commit", built_commit},      {"isa", isa},
                {"size", arguments.size},      {"repetitions", arguments.repetitions},
                {"scenes", Json::array()}};
    std::printf("%-22s %-9s %9s %9s %7s %7s\n", "scene", "kernel", "special", "general", "ratio",
                "spread");
    bool same = true;
    for (const std::string& file : arguments.scenes) {
        const Json row = measure(file, arguments, isa);
        print(row);
        same = same && row["same_bits"].get<bool>();
        report["scenes"].push_back(row);
    }
    report["flags"] = kernel_flags;
    report["load_before"] = load_at_start();
    report["load_after"] = load_now();
    if (!arguments.json.empty()) {
        AtomicFile file(arguments.json);
        file.write(report.dump(1) + "\n");
        file.commit();
    }
    if (!same)
        throw std::runtime_error("the general kernel gave other bits");
}

}  // namespace

int main(int argc, char** argv)
{
    Arguments arguments;
    packtrace::bench::Program program("packtrace_features",
                                      "Times each scene's own kernel against the general one");
    program.words("SCENE", arguments.scenes, "Scene files");
    program.text("--isa", arguments.isa, "Instruction set");
    program.number("--size", arguments.size, {16, 16384}, "Edge of the pictures, pixels");
    program.number("--repetitions", arguments.repetitions, {1, 10'000}, "Times each is measured");
    program.text("--json", arguments.json, "File to write the figures to");
    return program.run(argc, argv, [&] { run(arguments); });
}
