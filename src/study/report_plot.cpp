#include <algorithm>

#include "study/accuracy_name.hpp"
#include "study/plot.hpp"
#include "study/report_text.hpp"

namespace packtrace {
namespace {

// A logarithmic axis has no zero: exact pictures lie on this line.
constexpr double least_error = 1e-17;

std::string series_name(const Variant& variant)
{
    if (variant.study == Study::sampling)
        return variant.adaptive ? "adaptive" : "uniform";
    if (variant.study == Study::depth)
        return "depth";
    return (variant.kernel == Kernel::scalar ? "scalar " : "packets ") + variant.precision;
}

std::string point_label(const Variant& variant)
{
    if (variant.study != Study::arithmetic)
        return variant.name;
    const std::string isa = variant.kernel == Kernel::scalar ? "" : variant.isa + " ";
    const bool usual = variant.accuracy == Accuracy::exact;
    return isa + (usual ? "" : std::string(name_of(variant.accuracy)) + " ") + "x" +
           std::to_string(variant.threads);
}

PlotPoint point_of(const ReportRun& run, const std::string& label)
{
    return {1e3 * run.median, std::max(run.error.rmse, least_error), label};
}

PlotSeries pareto_front(const StudyReport& study)
{
    PlotSeries front{"Pareto front", {}, true};
    for (const ReportRun& run : study.runs)
        if (run.pareto)
            front.points.push_back(point_of(run, ""));
    std::sort(front.points.begin(), front.points.end(),
              [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    return front;
}

std::vector<PlotSeries> series_of(const StudyReport& study)
{
    std::vector<PlotSeries> all{pareto_front(study)};
    for (const ReportRun& run : study.runs) {
        const std::string name = series_name(run.variant);
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const PlotSeries& s) { return s.name == name; });
        PlotSeries& series =
            found != all.end() ? *found : all.emplace_back(PlotSeries{name, {}, false});
        series.points.push_back(point_of(run, point_label(run.variant)));
    }
    return all;
}

}  // namespace

std::string report_plot(const SceneReport& scene, const StudyReport& study)
{
    Plot plot;
    plot.title = scene.name + ": " + name_of(study.study);
    plot.x_title = "median time of a frame, ms";
    plot.y_title = "RMSE against the truth";
    plot.series = series_of(study);
    return draw_svg(plot);
}

// gnuplot numbers what it draws: the front, then each series' points and labels.
std::vector<PlotGroup> plot_groups(const StudyReport& study)
{
    std::vector<PlotGroup> groups;
    int number = 0;
    for (const PlotSeries& series : series_of(study)) {
        std::string ids = "gnuplot_plot_" + std::to_string(++number);
        if (!series.line)
            ids += " gnuplot_plot_" + std::to_string(++number);
        groups.push_back({series.name, ids});
    }
    return groups;
}

}  // namespace packtrace
