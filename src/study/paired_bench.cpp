#include "study/paired_bench.hpp"

#include <chrono>

#include "study/report_subject.hpp"
#include "study/statistics.hpp"

namespace packtrace {
namespace {

// Short frames are repeated until they take this share of the reference's time.
constexpr double least_share = 0.25;

double seconds_of(const Subject& subject)
{
    const auto start = std::chrono::steady_clock::now();
    subject.render();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Seconds of one frame, the mean of as many as take `least` seconds.
double mean_seconds(const Subject& subject, double least)
{
    double sum = 0.0;
    int frames = 0;
    for (; sum < least || frames == 0; ++frames)
        sum += seconds_of(subject);
    return sum / frames;
}

ReportOptions one_thread(const BenchOptions& options)
{
    ReportOptions wanted;
    wanted.threads = {1};
    wanted.isas = options.isas;
    return wanted;
}

std::vector<Variant> variants_of(const ReportScene& scene, const BenchOptions& options)
{
    std::vector<Variant> variants;
    for (const Variant& variant : report_variants(scene.scene, one_thread(options)))
        if (variant.study == Study::arithmetic && variant.accuracy == Accuracy::exact &&
            !variant.general && variant.self_hits == default_self_hits)
            variants.push_back(variant);
    return variants;
}

// The name without its one thread.
std::string line_name(const ReportScene& scene, const Variant& variant)
{
    return scene.name + ", " + variant.name.substr(0, variant.name.find(','));
}

void measure(const Subject& reference, const Subject& subject, int repetitions, BenchLine& line)
{
    std::vector<double> seconds;
    subject.render();
    for (int i = 0; i < repetitions; ++i) {
        const double measure = seconds_of(reference);
        seconds.push_back(mean_seconds(subject, least_share * measure));
        line.ratios.push_back(seconds.back() / measure);
    }
    line.ratio = median_of(line.ratios);
    line.spread = relative_spread(line.ratios);
    line.milliseconds = 1e3 * median_of(seconds);
}

}  // namespace

std::vector<BenchLine> run_bench(const ReportScene& scene, const BenchOptions& options)
{
    const std::vector<Variant> variants = variants_of(scene, options);
    // The table begins with the reference in single precision.
    const Subject reference = subject_of(scene.scene, variants.front());
    std::vector<BenchLine> lines;
    for (std::size_t i = 1; i < variants.size(); ++i) {
        BenchLine line;
        line.name = line_name(scene, variants[i]);
        measure(reference, subject_of(scene.scene, variants[i]), options.repetitions, line);
        lines.push_back(line);
    }
    return lines;
}

void repeat_line(const ReportScene& scene, const BenchOptions& options, BenchLine& line)
{
    const std::vector<Variant> variants = variants_of(scene, options);
    const Subject reference = subject_of(scene.scene, variants.front());
    for (const Variant& variant : variants)
        if (line_name(scene, variant) == line.name)
            measure(reference, subject_of(scene.scene, variant), options.repetitions, line);
}

}  // namespace packtrace
