#include "lab/report/report_text.hpp"

#include "lab/report/report_study.hpp"
#include <packtrace/compare.hpp>

#include <algorithm>

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

// The first few runs by name, and the number of the others.
std::string names_text(const std::vector<const ReportRun*>& runs)
{
    constexpr std::size_t most_named = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(runs.size(), most_named); ++i)
        text += (i > 0 ? "; " : "") + run_text(*runs[i]);
    if (runs.size() > most_named)
        text += "; and " + std::to_string(runs.size() - most_named) + " more";
    return text;
}

std::string cheapest_line(const StudyReport& study, double error)
{
    const RunChoice choice = cheapest_within(study, error);
    const std::string head = "Cheapest with an RMSE of at most " + brief(error) + ": ";
    if (choice.run == nullptr)
        return head + "none reaches it.";
    if (choice.undecided.empty())
        return head + run_text(*choice.run) + ".";
    return head + "undecided, as the spreads of their times overlap, between " +
           run_text(*choice.run) + "; " + names_text(choice.undecided) + ".";
}

std::string most_exact_line(const StudyReport& study, double seconds)
{
    const RunChoice choice = most_exact_within(study, seconds);
    const std::string head = "Most exact within " + milliseconds(seconds) + ": ";
    const std::string sure =
        choice.run != nullptr ? run_text(*choice.run) : "none is surely that fast";
    if (choice.undecided.empty())
        return head + (choice.run != nullptr ? sure : "none is that fast") + ".";
    return head + sure + "; perhaps, as their times spread over that limit, " +
           names_text(choice.undecided) + ".";
}

// The uniform run with a number of samples; null if there is none.
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
    // Adaptive sampling is compared with this many samples everywhere.
    constexpr int uniform_samples = 16;
    const ReportRun* uniform = uniform_run(study, uniform_samples);
    const ReportRun* adaptive = uniform == nullptr ? nullptr : best_adaptive(study, *uniform);
    if (adaptive == nullptr)
        return {};
    const bool decided = surely_faster(*adaptive, *uniform) || surely_faster(*uniform, *adaptive);
    const double of_rmse = adaptive->error.rmse / uniform->error.rmse;
    return "Adaptive sampling against " + std::to_string(uniform_samples) +
           " samples everywhere: " + adaptive->variant.name +
           (uniform->error.rmse > 0.0
                ? " reaches " + brief(of_rmse) + " of its RMSE"
                : " has an RMSE of " + brief(adaptive->error.rmse) + ", where that has 0,") +
           " in " + brief(adaptive->median / uniform->median) + " of its time" +
           (decided ? "." : ", though the spreads of their times overlap.");
}

/// For each run that cuts rays: the largest change of a pixel by that, compared with the run of all
/// rays, and its proven bound.
std::string bounds_line(const StudyReport& study)
{
    const auto whole = std::find_if(study.runs.begin(), study.runs.end(), [](const ReportRun& run) {
        return run.variant.min_weight == 0.0;
    });
    if (whole == study.runs.end())
        return {};
    const Image<double>& uncut = study.pictures[whole->picture].image;
    std::string text;
    for (const ReportRun& run : study.runs)
        if (run.cut.rays > 0)
            text += (text.empty() ? "" : ", ") + run.variant.name + " " +
                    brief(compare(study.pictures[run.picture].image, uncut).max_abs) + " of " +
                    brief(run.cut.bound);
    return text.empty()
               ? text
               : "Largest change of a pixel by rays left out, of its proven bound: " + text + ".";
}

}  // namespace

const char* name_of(Study study)
{
    switch (study) {
        case Study::arithmetic:
            return "arithmetic";
        case Study::depth:
            return "depth";
        case Study::weight:
            return "weight";
        case Study::sampling:
            break;
    }
    return "sampling";
}

const char* name_of(Pareto standing)
{
    switch (standing) {
        case Pareto::beaten:
            return "no";
        case Pareto::undecided:
            return "undecided";
        case Pareto::on_front:
            break;
    }
    return "yes";
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

std::string shares_text(const ReportRun& run)
{
    return joined(run.shares, ", ", [](const ErrorShare& share) {
        return share.kind + " " + std::to_string(share.pixels);
    });
}

std::string where_text(const ReportRun& run)
{
    const std::string text = shares_text(run);
    return run.looked_at_off || text.empty() ? text : "(" + text + ")";
}

std::string mrays_text(const ReportRun& run)
{
    return run.rays > 0 ? brief(1e-6 * static_cast<double>(run.rays) / run.median) : "";
}

std::string spread_text(const ReportRun& run)
{
    const double percent = 100.0 * run.spread;
    return fixed(percent, percent < 9.95 ? 1 : 0) + " %";
}

std::vector<ErrorShare> classes_of(const std::vector<SceneReport>& scenes)
{
    std::vector<ErrorShare> seen;
    const auto is_known = [&](const ErrorShare& share) {
        return std::any_of(seen.begin(), seen.end(),
                           [&](const ErrorShare& other) { return other.kind == share.kind; });
    };
    for (const SceneReport& scene : scenes)
        for (const StudyReport& study : scene.studies)
            for (const ReportRun& run : study.runs)
                for (const ErrorShare& share : run.shares)
                    if (!is_known(share))
                        seen.push_back(share);
    return seen;
}

std::vector<std::string> judgement(const StudyReport& study, const ReportOptions& options)
{
    std::vector<std::string> lines{cheapest_line(study, options.max_error),
                                   most_exact_line(study, options.max_time)};
    if (study.study == Study::sampling)
        if (const std::string line = adaptive_line(study); !line.empty())
            lines.push_back(line);
    if (study.study == Study::weight)
        if (const std::string line = bounds_line(study); !line.empty())
            lines.push_back(line);
    return lines;
}

}  // namespace packtrace
