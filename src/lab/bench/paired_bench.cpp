#include "lab/bench/paired_bench.hpp"

#include "lab/harness/stopwatch.hpp"

namespace packtrace {
namespace {

// Short frames are repeated until they take this share of the reference's time, which is enough for
// the clock.
constexpr double least_share = 0.25;

// Seconds of one frame: the mean of as many frames as take `least` seconds.
double mean_seconds(const Subject& subject, double least)
{
    double sum = 0.0;
    int frames = 0;
    for (; sum < least || frames == 0; ++frames)
        sum += seconds_of(1, subject.render);
    return sum / frames;
}

std::vector<Variant> variants_of(const ReportScene& scene, const std::vector<std::string>& isas)
{
    const ReportOptions one_thread{.threads = {1}, .isas = isas};
    std::vector<Variant> variants;
    for (const Variant& variant : report_variants(scene.scene, one_thread))
        if (variant.study == Study::arithmetic && variant.accuracy == Accuracy::exact &&
            !variant.general && variant.self_hits == default_self_hits)
            variants.push_back(variant);
    return variants;
}

// The name without ", 1 thread".
std::string line_name(const ReportScene& scene, const Variant& variant)
{
    return scene.name + ", " + variant.name.substr(0, variant.name.find(','));
}

}  // namespace

SceneBench::SceneBench(const ReportScene& scene, const std::vector<std::string>& isas)
{
    // The first variant is the reference in single precision.
    for (const Variant& variant : variants_of(scene, isas)) {
        BenchLine& line = subjects_.empty() ? reference_ : lines_.emplace_back();
        line.name = line_name(scene, variant);
        subjects_.push_back(subject_of(scene.scene, variant));
        // The first frame allocates memory that later ones reuse.
        subjects_.back().render();
    }
}

void SceneBench::measure(int repetitions, const std::function<bool(const BenchLine&)>& wanted)
{
    // `wanted` is asked before all measurements. Asked after each, it would stop at a lucky one.
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < lines_.size(); ++i)
        if (wanted(lines_[i]))
            chosen.push_back(i);
    for (int repetition = 0; repetition < repetitions; ++repetition)
        for (const std::size_t line : chosen)
            measure_once(line);
}

void SceneBench::measure_once(std::size_t line)
{
    const double reference = seconds_of(1, subjects_.front().render);
    const double seconds = mean_seconds(subjects_[line + 1], least_share * reference);
    reference_.seconds.push_back(reference);
    reference_.ratios.push_back(1.0);
    lines_[line].seconds.push_back(seconds);
    lines_[line].ratios.push_back(seconds / reference);
}

}  // namespace packtrace
