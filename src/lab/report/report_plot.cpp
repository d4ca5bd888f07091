#include "lab/report/plot.hpp"
#include "lab/report/report_study.hpp"
#include "lab/report/report_text.hpp"
#include "render/option_words.hpp"

#include <algorithm>
#include <utility>

namespace packtrace {
namespace {

std::string series_name(const Variant& variant)
{
    if (variant.study == Study::sampling)
        return variant.adaptive ? "adaptive" : "uniform";
    if (variant.study != Study::arithmetic)
        return name_of(variant.study);
    return (variant.kernel == Kernel::scalar ? "scalar " : "packets ") +
           std::string(language::word_of(variant.precision));
}

std::string point_label(const Variant& variant)
{
    if (variant.study != Study::arithmetic)
        return variant.name;
    const std::string isa = variant.kernel == Kernel::scalar ? "" : variant.isa + " ";
    const bool usual = variant.accuracy == Accuracy::exact;
    return isa + (usual ? "" : std::string(language::word_of(variant.accuracy)) + " ") +
           (variant.general ? "general " : "") +
           (variant.self_hits == default_self_hits ? "" : "from 0.001 ") + "x" +
           std::to_string(variant.threads);
}

PlotPoint point_of(const ReportRun& run, const std::string& label)
{
    const Interval times = middle_times(run);
    return {1e3 * run.median, run.error.rmse, label, 1e3 * times.low, 1e3 * times.high};
}

// The runs that are more exact than all runs with a smaller median.
PlotSeries front_of_medians(const StudyReport& study)
{
    PlotSeries front{.name = "Pareto front of medians", .line = true};
    std::vector<const ReportRun*> runs;
    for (const ReportRun& run : study.runs)
        runs.push_back(&run);
    std::sort(runs.begin(), runs.end(), [](const ReportRun* a, const ReportRun* b) {
        return std::pair(a->median, a->error.rmse) < std::pair(b->median, b->error.rmse);
    });
    for (const ReportRun* run : runs)
        if (front.points.empty() || run->error.rmse < front.points.back().y)
            front.points.push_back(point_of(*run, ""));
    return front;
}

std::vector<PlotSeries> series_of(const StudyReport& study)
{
    std::vector<PlotSeries> all{front_of_medians(study)};
    for (const ReportRun& run : study.runs) {
        const std::string name = series_name(run.variant);
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const PlotSeries& s) { return s.name == name; });
        PlotSeries& series =
            found != all.end() ? *found : all.emplace_back(PlotSeries{.name = name});
        series.points.push_back(point_of(run, point_label(run.variant)));
    }
    return all;
}

}  // namespace

std::string report_plot(const SceneReport& scene, const StudyReport& study)
{
    Plot plot{.title = scene.name + ": " + name_of(study.study),
              .x_title = "median time of a frame, ms; bars: its middle half",
              .y_title = "RMSE against the truth",
              .series = series_of(study)};
    return draw_svg(plot);
}

std::vector<PlotGroup> plot_groups(const StudyReport& study)
{
    std::vector<PlotGroup> groups;
    int number = 0;
    for (const PlotSeries& series : series_of(study)) {
        std::string ids;
        for (int i = 0; i < groups_of(series); ++i)
            ids += (i > 0 ? " " : "") + ("gnuplot_plot_" + std::to_string(++number));
        groups.push_back({series.name, ids, series_color(groups.size())});
    }
    return groups;
}

}  // namespace packtrace
