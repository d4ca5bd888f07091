// packtrace_cluster: the measurements for the model of many ranks in results/cluster.py, and the
// model. Both print JSON.
#include "cli/render/render_bands.hpp"
#include "core/seconds_since.hpp"
#include "job_model.hpp"
#include "program.hpp"
#include <packtrace/read_scene.hpp>

#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace packtrace::bench {
namespace {

using Json = nlohmann::ordered_json;

template <class Work>
double seconds_of(const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return seconds_since(start);
}

struct BandArguments {
    std::string scene;
    std::string output;
    int size = 16384;
    int bands = 64;
};

/// A file with more bytes is written row by row (largest_whole in image/formats.hpp).
constexpr std::size_t beyond_whole = std::size_t{144} << 20;

/// Renders some bands of a picture, spread over it, on one thread. Writes them again and again,
/// into a file so large that it is written row by row.
Json measure_bands(const BandArguments& arguments)
{
    Scene scene = read_scene(arguments.scene);
    scene.width = scene.height = arguments.size;
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const RowSamples samples(arguments.output, scene.width, 1.0);
    const cli::Bands bands =
        cli::cut_into_bands(scene.width, scene.height, samples.format(), cli::band_pixels);
    const auto render = cli::band_renderer(scene, Precision::single, {}, samples);
    const int count = std::min(arguments.bands, bands.count());
    const std::size_t band_bytes = samples.row_bytes() * static_cast<std::size_t>(bands.rows);

    // The first band allocates memory and starts threads.
    std::vector<Bytes> rendered(static_cast<std::size_t>(count), Bytes(band_bytes));
    render(bands.band(0), rendered[0]);
    Json work = Json::array();
    for (int i = 0; i < count; ++i) {
        const int number =
            static_cast<int>((std::int64_t{2} * i + 1) * bands.count() / (2 * count));
        work.push_back(
            seconds_of([&] { render(bands.band(number), rendered[static_cast<std::size_t>(i)]); }));
    }

    const auto written = static_cast<int>(
        std::max<std::size_t>(beyond_whole / band_bytes, static_cast<std::size_t>(count)));
    const double writing = seconds_of([&] {
        RowFile file(arguments.output, scene.width, written * bands.rows);
        for (int i = 0; i < written; ++i)
            file.write(rendered[static_cast<std::size_t>(i % count)]);
        file.commit();
    });
    return {{"pieces", bands.count()},
            {"band_bytes", band_bytes},
            {"write_seconds", writing / written},
            {"work_seconds", work}};
}

/// Simulates one job on several numbers of ranks.
Json simulate(const Json& asked)
{
    const auto profile = asked.at("work_seconds").get<std::vector<double>>();
    ModelJob job;
    job.pieces = asked.at("pieces");
    job.piece_bytes = asked.at("band_bytes");
    job.write = asked.at("write_seconds");
    job.latency = asked.at("latency");
    job.bytes_per_second = asked.at("bytes_per_second");
    job.ask = asked.at("ask_seconds");
    job.counter = asked.at("counter_seconds");
    job.work = [&](int piece) {
        return profile[static_cast<std::size_t>(piece) * profile.size() /
                       static_cast<std::size_t>(job.pieces)];
    };
    Json runs = Json::array();
    for (const int ranks : asked.at("ranks")) {
        job.ranks = ranks;
        const ModelRun run = JobModel(job).run();
        runs.push_back({{"ranks", ranks},
                        {"seconds", run.seconds},
                        {"working", run.working / (run.seconds * ranks)},
                        {"writer", run.writer_busy / run.seconds},
                        {"link", run.link_busy / run.seconds},
                        {"counter", run.counter_busy / run.seconds}});
    }
    return runs;
}

}  // namespace
}  // namespace packtrace::bench

int main(int argc, char** argv)
{
    using namespace packtrace::bench;
    Program program("packtrace_cluster",
                    "Measures bands of a picture, or simulates a job of many ranks");
    BandArguments arguments;
    Program& bands = program.command("bands", "Seconds to render and write bands", [&] {
        std::cout << measure_bands(arguments).dump(1) << '\n';
    });
    bands.text("SCENE", arguments.scene, "Scene file");
    bands.text("-o", arguments.output, "Picture to write, .png or .pfm", Need::required);
    bands.number("--size", arguments.size, {1, 65536}, "Edge of the picture in pixels");
    bands.number("--bands", arguments.bands, {1, 65536}, "How many to render");
    program.command("model", "Simulate a job that standard input describes",
                    [] { std::cout << simulate(Json::parse(std::cin)).dump(1) << '\n'; });
    return program.run(argc, argv);
}
