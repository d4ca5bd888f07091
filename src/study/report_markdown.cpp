#include <sstream>

#include "study/report_text.hpp"

namespace packtrace {
namespace {

void write_conditions(std::ostream& to, const ReportOptions& options,
                      const ReportConditions& conditions)
{
    to << "# Error against run time\n\n"
       << "| | |\n|---|---|\n"
       << "| command | `" << conditions.command << "` |\n"
       << "| commit | " << conditions.commit << " |\n"
       << "| processor | " << conditions.processor << ", " << conditions.processors << " in use |\n"
       << "| compiler | " << conditions.compiler << " |\n\n"
       << "Times are medians of " << options.repetitions
       << " frames, taken in turns with those of the other runs; the spread is the width of their "
          "middle half over the median. The scene is made ready before. Errors are of linear "
          "values, 1 for full; a pixel is off when a channel differs by more than "
       << brief(options.threshold)
       << ". **Bold** runs lie on the Pareto front: none is both faster "
          "and more exact. *Where* tells, by comparing ray trees with the reference's, why pixels "
          "are off, or in brackets, where none is, why the worst ones differ.\n";
}

std::string where(const ReportRun& run)
{
    const std::string text = shares_text(run);
    return run.looked_at_off || text.empty() ? text : "(" + text + ")";
}

void write_run(std::ostream& to, const ReportRun& run)
{
    const std::string mark = run.pareto ? "**" : "";
    to << "| " << mark << run.variant.name << mark << " | " << brief(1e3 * run.median) << " | "
       << brief(100.0 * run.spread, 2) << " % | "
       << (run.rays > 0 ? brief(1e-6 * static_cast<double>(run.rays) / run.median) : "") << " | "
       << brief(run.error.rmse) << " | " << brief(run.error.max_abs) << " | "
       << brief(run.error.psnr) << " | " << run.error.pixels_off << " | " << where(run) << " |\n";
}

void write_study(std::ostream& to, const SceneReport& scene, const StudyReport& study,
                 const ReportOptions& options)
{
    to << "\n### " << scene.name << ": " << name_of(study.study) << "\n\n"
       << "Truth: " << study.truth << "; " << brief(study.truth_seconds) << " s"
       << (study.truth_cached ? " when it was made" : "") << ".\n\n"
       << "| run | ms | spread | Mrays/s | RMSE | max | PSNR, dB | pixels off | where |\n"
       << "|---|---|---|---|---|---|---|---|---|\n";
    for (const ReportRun& run : study.runs)
        write_run(to, run);
    to << '\n';
    for (const std::string& line : judgement(study, options))
        to << "- " << line << '\n';
    to << "\n![error against time](" << plot_file(scene, study) << ")\n";
}

void write_classes(std::ostream& to, const std::vector<SceneReport>& scenes)
{
    std::vector<ErrorShare> seen;
    for (const SceneReport& scene : scenes)
        for (const StudyReport& study : scene.studies)
            for (const ReportRun& run : study.runs)
                for (const ErrorShare& share : run.shares) {
                    bool known = false;
                    for (const ErrorShare& other : seen)
                        known = known || other.kind == share.kind;
                    if (!known)
                        seen.push_back(share);
                }
    if (seen.empty())
        return;
    to << "\n## Classes of error\n\n";
    for (const ErrorShare& share : seen)
        to << "- *" << share.kind << "*: " << share.meaning << ".\n";
}

}  // namespace

std::string report_markdown(const std::vector<SceneReport>& scenes, const ReportOptions& options,
                            const ReportConditions& conditions)
{
    std::ostringstream text;
    write_conditions(text, options, conditions);
    for (const SceneReport& scene : scenes) {
        text << "\n## " << scene.name << ", " << scene.width << " x " << scene.height << "\n\n"
             << "![the truth](" << picture_file(scene, scene.studies.front(), 0) << ")\n";
        for (const StudyReport& study : scene.studies)
            write_study(text, scene, study, options);
    }
    write_classes(text, scenes);
    return text.str();
}

}  // namespace packtrace
