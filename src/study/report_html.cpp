#include <sstream>

#include <nlohmann/json.hpp>
#include <packtrace/compare.hpp>

#include "core/base64.hpp"
#include "image/png.hpp"
#include "study/plot.hpp"
#include "study/report_page.hpp"
#include "study/report_text.hpp"

namespace packtrace {
namespace {

std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text)
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    return result;
}

std::string png_uri(const Image<float>& image)
{
    return "data:image/png;base64," + base64(encode_png(image));
}

// Every picture of the report and its heat map, by its file's name.
nlohmann::ordered_json pictures_json(const std::vector<SceneReport>& scenes)
{
    nlohmann::ordered_json json;
    for (const SceneReport& scene : scenes)
        for (const StudyReport& study : scene.studies)
            for (std::size_t i = 0; i < study.pictures.size(); ++i) {
                const Image<double>& image = study.pictures[i].image;
                json[picture_file(scene, study, i)] = png_uri(convert<float>(image));
                if (i > 0)
                    json[error_file(scene, study, i)] =
                        png_uri(heatmap(image, study.pictures.front().image));
            }
    return json;
}

void write_choice(std::ostream& to, const SceneReport& scene, const std::string& chosen)
{
    to << "<select>";
    const auto option = [&](const std::string& file) {
        to << "<option" << (file == chosen ? " selected" : "") << " value=\"" << escaped(file)
           << "\">" << escaped(file.substr(scene.name.size() + 1)) << "</option>";
    };
    for (const StudyReport& study : scene.studies)
        for (std::size_t i = 0; i < study.pictures.size(); ++i) {
            option(picture_file(scene, study, i));
            if (i > 0)
                option(error_file(scene, study, i));
        }
    to << "</select>";
}

void write_slider(std::ostream& to, const SceneReport& scene)
{
    const StudyReport& first = scene.studies.front();
    to << "<div class=\"slider\"><div class=\"controls\">";
    write_choice(to, scene, picture_file(scene, first, 0));
    to << "<input type=\"range\" min=\"0\" max=\"100\" value=\"50\" "
          "aria-label=\"where the right picture begins\">";
    write_choice(
        to, scene,
        first.pictures.size() > 1 ? error_file(scene, first, 1) : picture_file(scene, first, 0));
    to << "</div><div class=\"compare\"><img class=\"left\" alt=\"left picture\">"
          "<img class=\"right\" alt=\"right picture\"></div></div>\n";
}

void write_row(std::ostream& to, const ReportRun& run)
{
    to << "<tr" << (run.pareto ? " class=\"pareto\"" : "") << "><td>" << escaped(run.variant.name);
    for (const std::string& cell :
         {brief(1e3 * run.median), brief(100.0 * run.spread, 2) + " %", brief(run.error.rmse),
          brief(run.error.max_abs), std::to_string(run.error.pixels_off),
          (run.looked_at_off || run.shares.empty()) ? shares_text(run)
                                                    : "(" + shares_text(run) + ")"})
        to << "</td><td>" << escaped(cell);
    to << "</td></tr>\n";
}

void write_plot(std::ostream& to, const SceneReport& scene, const StudyReport& study)
{
    const std::string svg = report_plot(scene, study);
    to << "<div class=\"plot\">";
    for (const PlotGroup& group : plot_groups(study)) {
        to << "<label><input type=\"checkbox\" checked data-groups=\"" << group.ids << "\"> "
           << escaped(group.name) << "</label>";
    }
    // What stands before the element is for files.
    to << svg.substr(svg.find("<svg")) << "</div>\n";
}

void write_section(std::ostream& to, const SceneReport& scene, const StudyReport& study,
                   const ReportOptions& options)
{
    to << "<h3>" << name_of(study.study) << "</h3>\n<p>Truth: " << escaped(study.truth)
       << ".</p>\n";
    write_plot(to, scene, study);
    to << "<table><tr><th>run</th><th>ms</th><th>spread</th><th>RMSE</th><th>max</th>"
          "<th>pixels off</th><th>where</th></tr>\n";
    for (const ReportRun& run : study.runs)
        write_row(to, run);
    to << "</table>\n<ul>";
    for (const std::string& line : judgement(study, options))
        to << "<li>" << escaped(line) << "</li>";
    to << "</ul>\n";
}

}  // namespace

std::string report_html(const std::vector<SceneReport>& scenes, const ReportOptions& options,
                        const ReportConditions& conditions)
{
    std::ostringstream page;
    page << "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
            "<title>packtrace: error against run time</title>"
            "<link rel=\"icon\" href=\"data:,\"><style>"
         << page_style << "</style></head><body>\n<h1>Error against run time</h1>\n<p><code>"
         << escaped(conditions.command) << "</code><br>" << escaped(conditions.processor) << ", "
         << conditions.processors << " in use; " << escaped(conditions.compiler) << "; commit "
         << escaped(conditions.commit) << "; medians of " << options.repetitions
         << " frames taken in turns</p>\n";
    for (const SceneReport& scene : scenes) {
        page << "<h2>" << escaped(scene.name) << ", " << scene.width << " x " << scene.height
             << "</h2>\n";
        write_slider(page, scene);
        for (const StudyReport& study : scene.studies)
            write_section(page, scene, study, options);
    }
    page << "<script type=\"application/json\" id=\"pictures\">" << pictures_json(scenes).dump()
         << "</script>\n<script>" << page_script << "</script></body></html>\n";
    return page.str();
}

}  // namespace packtrace
