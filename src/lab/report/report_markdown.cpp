#include "lab/report/report_text.hpp"

#include <sstream>

namespace packtrace {
namespace {

/// A text as code in a cell of a table, with bars escaped, which would end the cell.
std::string code_cell(const std::string& text)
{
    const bool has_fence = text.find('`') != std::string::npos;
    return (has_fence ? "`` " : "`") + replaced(text, '|', "\\|") + (has_fence ? " ``" : "`");
}

/// A text with all characters escaped that have a meaning in Markdown.
std::string plain(const std::string& text)
{
    constexpr std::string_view marks = "\\`*_{}[]<>()#+!|&~";
    std::string result;
    for (const char c : text) {
        if (marks.find(c) != std::string_view::npos)
            result += '\\';
        result += c;
    }
    return result;
}

/// A file's name in a link (RFC 3986).
std::string link_to(const std::string& file)
{
    constexpr std::string_view unreserved =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
    constexpr const char* digits = "0123456789ABCDEF";
    std::string result;
    for (const char c : file) {
        if (unreserved.find(c) != std::string_view::npos) {
            result += c;
            continue;
        }
        const auto byte = static_cast<unsigned char>(c);
        result += {'%', digits[byte >> 4u], digits[byte & 15u]};
    }
    return result;
}

void write_conditions(std::ostream& to, const ReportOptions& options,
                      const ReportConditions& conditions)
{
    to << "# Error against run time\n\n"
       << "| | |\n|---|---|\n"
       << "| command | " << code_cell(conditions.command) << " |\n"
       << "| commit | " << conditions.commit << " |\n"
       << "| processor | " << conditions.processor << ", " << conditions.processors << " in use |\n"
       << "| compiler | " << conditions.compiler << " |\n\n"
       << "Times are medians of " << options.repetitions
       << " frames, taken in turns with those of the other runs; the spread is the width of their "
          "middle half over the median. The scene is made ready before. Errors are of linear "
          "values, 1 for full; a pixel is off when a channel differs by more than "
       << brief(options.threshold)
       << ". **Bold** runs lie on the Pareto front: every run that is as exact is slower. "
          "*Slanted* "
          "ones perhaps do: another run is as exact, and the spreads of their times overlap. "
          "*Where* tells, by comparing ray trees with the reference's, why pixels are off, or in "
          "brackets, where none is, why the worst ones differ.\n";
}

const char* mark_of(Pareto standing)
{
    switch (standing) {
        case Pareto::on_front:
            return "**";
        case Pareto::undecided:
            return "*";
        case Pareto::beaten:
            break;
    }
    return "";
}

void write_run(std::ostream& to, const ReportRun& run)
{
    const std::string mark = mark_of(run.pareto);
    to << "| " << mark << run.variant.name << mark << " | " << brief(1e3 * run.median) << " | "
       << spread_text(run) << " | " << mrays_text(run) << " | " << brief(run.error.rmse) << " | "
       << brief(run.error.max_abs) << " | " << brief(run.error.psnr) << " | "
       << run.error.pixels_off << " | " << where_text(run) << " |\n";
}

void write_study(std::ostream& to, const SceneReport& scene, const StudyReport& study,
                 const ReportOptions& options)
{
    to << "\n### " << plain(scene.name) << ": " << name_of(study.study) << "\n\n"
       << "Truth: " << study.truth << "; " << brief(study.truth_seconds) << " s"
       << (study.truth_cached ? " when it was made" : "") << ".\n\n"
       << "| run | ms | spread | Mrays/s | RMSE | max | PSNR, dB | pixels off | where |\n"
       << "|---|---|---|---|---|---|---|---|---|\n";
    for (const ReportRun& run : study.runs)
        write_run(to, run);
    to << '\n';
    for (const std::string& line : judgement(study, options))
        to << "- " << line << '\n';
    to << "\n![error against time](" << link_to(plot_file(scene, study)) << ")\n";
}

void write_classes(std::ostream& to, const std::vector<SceneReport>& scenes)
{
    const std::vector<ErrorShare> seen = classes_of(scenes);
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
        text << "\n## " << plain(scene.name) << ", " << scene.width << " x " << scene.height
             << "\n\n"
             << "![the truth](" << link_to(picture_file(scene, scene.studies.front(), 0)) << ")\n";
        for (const StudyReport& study : scene.studies)
            write_study(text, scene, study, options);
    }
    write_classes(text, scenes);
    return text.str();
}

}  // namespace packtrace
