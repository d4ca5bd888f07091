#include "study/report_text.hpp"

#include <cstdio>

namespace packtrace {
namespace {

std::string stem(const SceneReport& scene, const StudyReport& study, std::size_t picture)
{
    return scene.name + "/" + name_of(study.study) + "_" + study.pictures[picture].name;
}

std::string milliseconds(double seconds)
{
    return brief(1e3 * seconds) + " ms";
}

std::string run_text(const ReportRun& run)
{
    return run.variant.name + " (" + milliseconds(run.median) + ", RMSE " + brief(run.error.rmse) +
           ")";
}

// The uniform run of that many samples; null when there is none.
const ReportRun* uniform_run(const StudyReport& study, int samples)
{
    for (const ReportRun& run : study.runs)
        if (!run.variant.adaptive && run.variant.samples == samples)
            return &run;
    return nullptr;
}

// The fastest adaptive run that is at least as exact as `uniform`, else the most exact.
const ReportRun* best_adaptive(const StudyReport& study, const ReportRun& uniform)
{
    const ReportRun* best = nullptr;
    for (const ReportRun& run : study.runs) {
        if (!run.variant.adaptive)
            continue;
        const bool exact = run.error.rmse <= uniform.error.rmse;
        const bool best_exact = best != nullptr && best->error.rmse <= uniform.error.rmse;
        if (best == nullptr || (exact && !best_exact) ||
            (exact == best_exact &&
             (exact ? run.median < best->median : run.error.rmse < best->error.rmse)))
            best = &run;
    }
    return best;
}

std::string adaptive_line(const StudyReport& study)
{
    const ReportRun* uniform = uniform_run(study, 16);
    const ReportRun* adaptive = uniform == nullptr ? nullptr : best_adaptive(study, *uniform);
    if (adaptive == nullptr)
        return {};
    return "Adaptive sampling against 16 samples everywhere: " + adaptive->variant.name +
           " reaches " + brief(adaptive->error.rmse / uniform->error.rmse) + " of its RMSE in " +
           brief(adaptive->median / uniform->median) + " of its time.";
}

}  // namespace

const char* name_of(Study study)
{
    switch (study) {
        case Study::arithmetic:
            return "arithmetic";
        case Study::depth:
            return "depth";
        case Study::sampling:
            break;
    }
    return "sampling";
}

std::string picture_file(const SceneReport& scene, const StudyReport& study, std::size_t picture)
{
    return stem(scene, study, picture) + ".png";
}

std::string error_file(const SceneReport& scene, const StudyReport& study, std::size_t picture)
{
    return stem(scene, study, picture) + "_error.png";
}

std::string plot_file(const SceneReport& scene, const StudyReport& study)
{
    return scene.name + "/" + name_of(study.study) + ".svg";
}

std::string brief(double value, int digits)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

std::string shares_text(const ReportRun& run)
{
    std::string text;
    for (const ErrorShare& share : run.shares)
        text += (text.empty() ? "" : ", ") + share.kind + " " + std::to_string(share.pixels);
    return text;
}

std::vector<std::string> judgement(const StudyReport& study, const ReportOptions& options)
{
    const ReportRun* cheapest = cheapest_within(study, options.max_error);
    const ReportRun* exact = most_exact_within(study, options.max_time);
    std::vector<std::string> lines{
        "Cheapest with an RMSE of at most " + brief(options.max_error) + ": " +
            (cheapest != nullptr ? run_text(*cheapest) : "none reaches it") + ".",
        "Most exact within " + milliseconds(options.max_time) + ": " +
            (exact != nullptr ? run_text(*exact) : "none is that fast") + "."};
    if (study.study == Study::sampling)
        if (const std::string line = adaptive_line(study); !line.empty())
            lines.push_back(line);
    return lines;
}

}  // namespace packtrace
