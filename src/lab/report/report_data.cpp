#include "core/json_text.hpp"
#include "lab/report/report_text.hpp"
#include "render/option_words.hpp"

#include <nlohmann/json.hpp>

#include <sstream>

// The report as data for programs: CSV and JSON.
namespace packtrace {
namespace {

// A field between quotes, because some names have commas.
std::string csv_text(const std::string& text)
{
    return '"' + replaced(text, '"', "\"\"") + '"';
}

std::string exact(double value)
{
    return brief(value, 9);
}

void write_row(std::ostream& to, const SceneReport& scene, const StudyReport& study,
               const ReportRun& run)
{
    const Variant& variant = run.variant;
    to << csv_text(scene.name) << ',' << scene.width << ',' << scene.height << ','
       << name_of(study.study) << ',' << csv_text(variant.name) << ','
       << language::word_of(variant.kernel) << ',' << language::word_of(variant.precision) << ','
       << variant.isa << ',' << (has_accuracy(variant) ? language::word_of(variant.accuracy) : "")
       << ',' << variant.lanes << ',' << variant.threads << ',' << variant.depth << ','
       << exact(variant.min_weight) << ',' << variant.samples << ','
       << (variant.adaptive ? exact(*variant.adaptive) : "") << ',' << exact(run.median) << ','
       << exact(run.spread) << ',' << run.rays << ',' << run.cut.rays << ',' << exact(run.cut.bound)
       << ',' << exact(run.error.rmse) << ',' << exact(run.error.max_abs) << ','
       << exact(run.error.psnr) << ',' << run.error.pixels << ',' << run.error.pixels_off << ','
       << name_of(run.pareto) << ',' << csv_text(shares_text(run)) << '\n';
}

}  // namespace

std::string report_csv(const std::vector<SceneReport>& scenes)
{
    std::ostringstream csv;
    csv << "scene,width,height,study,run,kernel,precision,isa,accuracy,lanes,threads,depth,min_"
           "weight,"
           "samples,adaptive,median_s,spread,rays,cut_rays,cut_bound,rmse,max_abs,psnr,pixels,"
           "pixels_off,pareto,errors\n";
    for (const SceneReport& scene : scenes)
        for (const StudyReport& study : scene.studies)
            for (const ReportRun& run : study.runs)
                write_row(csv, scene, study, run);
    return csv.str();
}

namespace {

using Json = nlohmann::ordered_json;

Json error_json(const ReportRun& run)
{
    Json classes = Json::array();
    for (const ErrorShare& share : run.shares)
        classes.push_back({{"class", share.kind},
                           {"meaning", share.meaning},
                           {"pixels", share.pixels},
                           {"squared_error_share", share.squared_error}});
    return {
        {"rmse", finite_or_null(run.error.rmse)}, {"max_abs", finite_or_null(run.error.max_abs)},
        {"psnr", finite_or_null(run.error.psnr)}, {"pixels", run.error.pixels},
        {"pixels_off", run.error.pixels_off},     {"looked_at", run.looked_at},
        {"looked_at_off", run.looked_at_off},     {"classes", classes}};
}

Json run_json(const SceneReport& scene, const StudyReport& study, const ReportRun& run)
{
    const Variant& variant = run.variant;
    const bool packet = variant.kernel == Kernel::packet;
    return {
        {"name", variant.name},
        {"kernel", packet ? "packet" : "scalar"},
        {"precision", language::word_of(variant.precision)},
        {"isa", packet ? Json(variant.isa) : Json()},
        {"accuracy", has_accuracy(variant) ? Json(language::word_of(variant.accuracy)) : Json()},
        {"lanes", variant.lanes},
        {"threads", variant.threads},
        {"depth", variant.depth},
        {"min_weight", variant.min_weight},
        {"samples", variant.samples},
        {"adaptive", variant.adaptive ? Json(*variant.adaptive) : Json()},
        {"median_s", run.median},
        {"spread", run.spread},
        {"seconds", run.seconds},
        {"rays", packet ? Json(run.rays) : Json()},
        {"cut_rays", run.cut.rays},
        {"cut_bound", finite_or_null(run.cut.bound)},
        {"pareto", name_of(run.pareto)},
        {"error", error_json(run)},
        {"picture", picture_file(scene, study, run.picture)}};
}

Json choice_json(const RunChoice& choice)
{
    Json undecided = Json::array();
    for (const ReportRun* run : choice.undecided)
        undecided.push_back(run->variant.name);
    return {{"run", choice.run != nullptr ? Json(choice.run->variant.name) : Json()},
            {"undecided", undecided}};
}

Json study_json(const SceneReport& scene, const StudyReport& study, const ReportOptions& options)
{
    Json runs = Json::array();
    for (const ReportRun& run : study.runs)
        runs.push_back(run_json(scene, study, run));
    return {{"study", name_of(study.study)},
            {"truth",
             {{"what", study.truth},
              {"seconds", study.truth_seconds},
              {"cached", study.truth_cached},
              {"picture", picture_file(scene, study, 0)}}},
            {"plot", plot_file(scene, study)},
            {"cheapest_within_max_error", choice_json(cheapest_within(study, options.max_error))},
            {"most_exact_within_max_time", choice_json(most_exact_within(study, options.max_time))},
            {"judgement", judgement(study, options)},
            {"runs", runs}};
}

}  // namespace

std::string report_json(const std::vector<SceneReport>& scenes, const ReportOptions& options,
                        const ReportConditions& conditions)
{
    Json json{{"packtrace_report", 1},
              {"conditions",
               {{"processor", conditions.processor},
                {"processors", conditions.processors},
                {"compiler", conditions.compiler},
                {"flags", conditions.flags},
                {"commit", conditions.commit},
                {"load_before", conditions.load_before},
                {"load_after", conditions.load_after},
                {"command", conditions.command}}},
              {"repetitions", options.repetitions},
              {"threshold", options.threshold},
              {"max_error", options.max_error},
              {"max_time_s", options.max_time},
              {"scenes", Json::array()}};
    for (const SceneReport& scene : scenes) {
        Json studies = Json::array();
        for (const StudyReport& study : scene.studies)
            studies.push_back(study_json(scene, study, options));
        json["scenes"].push_back({{"name", scene.name},
                                  {"width", scene.width},
                                  {"height", scene.height},
                                  {"studies", studies}});
    }
    return json_text(json);
}

}  // namespace packtrace
