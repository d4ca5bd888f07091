#include "image/formats.hpp"
#include "lab/report/plot.hpp"
#include "lab/report/report_page.hpp"
#include "lab/report/report_pictures.hpp"
#include "lab/report/report_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>

namespace packtrace {
namespace {

std::string escaped(const std::string& text)
{
    return replaced(replaced(replaced(text, '&', "&amp;"), '<', "&lt;"), '"', "&quot;");
}

// JSON for a script element, without "<", which could begin a tag.
std::string json_in_page(const nlohmann::ordered_json& json)
{
    return replaced(json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace),
                    '<', "\\u003c");
}

// Base64 by RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes)
{
    constexpr const char* alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? alphabet[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string png_uri(const Image<float>& image)
{
    return "data:image/png;base64," + base64(encode_png(image));
}

// What is shown of a picture.
enum class Shown { picture, error_map };
constexpr Shown all_shown[] = {Shown::picture, Shown::error_map};

// A picture or an error map that the page can show.
struct Choice {
    const StudyReport* study = nullptr;
    std::size_t picture = 0;
    Shown shown = Shown::picture;

    [[nodiscard]] bool is_error() const
    {
        return shown == Shown::error_map;
    }
    [[nodiscard]] std::string file(const SceneReport& scene) const
    {
        return is_error() ? error_file(scene, *study, picture)
                          : picture_file(scene, *study, picture);
    }
    [[nodiscard]] std::string label() const
    {
        return (is_error() ? "error of " : "") + picture_label(*study, picture);
    }
    [[nodiscard]] std::string uri() const
    {
        return png_uri(is_error() ? error_map(*study, picture)
                                  : convert<float>(study->pictures[picture].image));
    }
};

// The truth, which is picture 0, has no error map.
std::vector<Choice> choices_of(const StudyReport& study, Shown shown)
{
    std::vector<Choice> choices;
    for (std::size_t i = shown == Shown::error_map ? 1 : 0; i < study.pictures.size(); ++i)
        choices.push_back({&study, i, shown});
    return choices;
}

// What a slider shows at first: the truth, and the error map of the first other picture.
Choice first_left(const SceneReport& scene)
{
    return {&scene.studies.front(), 0, Shown::picture};
}
Choice first_right(const SceneReport& scene)
{
    const StudyReport& study = scene.studies.front();
    return study.pictures.size() > 1 ? Choice{&study, 1, Shown::error_map} : first_left(scene);
}

// All pictures by their files' names, without those that are in the page already.
nlohmann::ordered_json pictures_json(const std::vector<SceneReport>& scenes)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const SceneReport& scene : scenes)
        for (const StudyReport& study : scene.studies)
            for (const Shown shown : all_shown)
                for (const Choice& choice : choices_of(study, shown)) {
                    const std::string file = choice.file(scene);
                    if (file != first_left(scene).file(scene) &&
                        file != first_right(scene).file(scene))
                        json[file] = choice.uri();
                }
    return json;
}

// The errors that are black and white in an error map, as an element's attributes.
std::string scale_data(const Choice& choice)
{
    if (!choice.is_error())
        return {};
    const double most = largest_error(*choice.study, choice.picture);
    return " data-least=\"" + brief(least_error_shown(most), 2) + "\" data-most=\"" +
           brief(most, 2) + "\"";
}

void write_menu(std::ostream& to, const SceneReport& scene, const std::string& side,
                const Choice& first)
{
    const std::string chosen = first.file(scene);
    to << "<label>" << side << "<select class=\"" << side << "\">";
    for (const StudyReport& study : scene.studies)
        for (const Shown shown : all_shown) {
            const std::vector<Choice> choices = choices_of(study, shown);
            if (choices.empty())
                continue;
            to << "<optgroup label=\"" << name_of(study.study)
               << (shown == Shown::error_map ? ": heat maps of errors" : ": pictures") << "\">";
            for (const Choice& choice : choices) {
                const std::string file = choice.file(scene);
                to << "<option" << (file == chosen ? " selected" : "") << " value=\""
                   << escaped(file) << '"' << scale_data(choice) << '>' << escaped(choice.label())
                   << "</option>";
            }
            to << "</optgroup>";
        }
    to << "</select></label>";
}

// Small pictures are enlarged to about this width, by whole pixels.
constexpr int picture_width = 512;

int scale_of(const Image<double>& image)
{
    return std::max(1, picture_width / std::max(1, image.width));
}

void write_first_picture(std::ostream& to, const std::string& side, const Choice& choice)
{
    const Image<double>& image = choice.study->pictures[choice.picture].image;
    const int scale = scale_of(image);
    to << "<img class=\"" << side << "\" width=\"" << scale * image.width << "\" height=\""
       << scale * image.height << "\" alt=\"" << escaped(choice.label()) << "\" src=\""
       << choice.uri() << "\">";
}

void write_scale(std::ostream& to, const std::string& side, const Choice& choice)
{
    const double most = choice.is_error() ? largest_error(*choice.study, choice.picture) : 0.0;
    to << "<div class=\"scale " << side << '"' << (choice.is_error() ? "" : " hidden")
       << "><span>error of a pixel, " << side
       << ":</span><span class=\"range\"><span class=\"least\">"
       << brief(least_error_shown(most), 2)
       << "</span><span class=\"bar\"></span><span class=\"most\">" << brief(most, 2)
       << "</span></span><span class=\"soft\">logarithmic; black for less, or none</span></div>";
}

void write_slider(std::ostream& to, const SceneReport& scene)
{
    const Choice left = first_left(scene);
    const Choice right = first_right(scene);
    const Image<double>& truth = scene.studies.front().pictures.front().image;
    to << "<div class=\"slider\" style=\"--width:" << scale_of(truth) * truth.width
       << "px\"><div class=\"controls\">";
    write_menu(to, scene, "left", left);
    write_menu(to, scene, "right", right);
    to << "<input type=\"range\" min=\"0\" max=\"100\" value=\"50\" "
          "aria-label=\"where the right picture begins\"></div><div class=\"compare\">";
    write_first_picture(to, "left", left);
    write_first_picture(to, "right", right);
    to << "<span class=\"edge\"></span></div>";
    write_scale(to, "left", left);
    write_scale(to, "right", right);
    to << "<p class=\"soft without-script\">" << escaped(left.label()) << ", and "
       << escaped(right.label())
       << ". The folder of the scene has all other pictures; with scripts they can be chosen "
          "here.</p></div>\n";
}

void write_page_row(std::ostream& to, const ReportRun& run)
{
    to << "<tr class=\"" << name_of(run.pareto) << "\"><td>" << escaped(run.variant.name);
    for (const std::string& cell :
         {brief(1e3 * run.median), spread_text(run), mrays_text(run), brief(run.error.rmse),
          brief(run.error.max_abs), brief(run.error.psnr), std::to_string(run.error.pixels_off),
          where_text(run)})
        to << "</td><td>" << escaped(cell);
    to << "</td></tr>\n";
}

void write_page_table(std::ostream& to, const StudyReport& study)
{
    to << "<div class=\"scroll\"><table><thead><tr><th>run</th><th>ms</th><th>spread</th>"
          "<th>Mrays/s</th><th>RMSE</th><th>max</th><th>PSNR, dB</th><th>pixels off</th>"
          "<th>where</th></tr></thead><tbody>\n";
    for (const ReportRun& run : study.runs)
        write_page_row(to, run);
    to << "</tbody></table></div>\n";
}

/// A plot with `suffix` appended to its ids, which gnuplot makes the same in all plots.
std::string with_own_ids(const std::string& svg, const std::string& suffix)
{
    std::string result;
    std::size_t at = 0;
    for (;;) {
        const std::size_t name = std::min({svg.find(" id='", at), svg.find(" id=\"", at),
                                           svg.find(":href='#", at), svg.find(":href=\"#", at)});
        const std::size_t open = svg.find_first_of("'\"", name);
        const std::size_t close = open == std::string::npos ? open : svg.find(svg[open], open + 1);
        if (close == std::string::npos)
            return result + svg.substr(at);
        result.append(svg, at, close - at).append(suffix);
        at = close;
    }
}

void write_plot(std::ostream& to, const SceneReport& scene, const StudyReport& study, int number)
{
    const std::string suffix = "_of_" + std::to_string(number);
    const std::string svg = with_own_ids(report_plot(scene, study), suffix);
    to << "<div class=\"plot\"><div class=\"series\">";
    for (const PlotGroup& group : plot_groups(study))
        to << "<label><input type=\"checkbox\" checked data-groups=\""
           << replaced(group.ids, ' ', suffix + " ") << suffix << "\"> "
           << "<span class=\"swatch\" style=\"background:" << group.color << "\"></span>"
           << escaped(group.name) << "</label>";
    // Without the XML header before the element.
    to << "</div><div class=\"canvas\">" << svg.substr(svg.find("<svg")) << "</div></div>\n";
}

const char* title_of(Study study)
{
    switch (study) {
        case Study::arithmetic:
            return "Arithmetic: kernels, precisions, instruction sets, threads";
        case Study::depth:
            return "Depth: how many reflections and refractions";
        case Study::weight:
            return "Weights: how little a ray may count to be traced";
        case Study::sampling:
            break;
    }
    return "Sampling: how many samples a pixel";
}

void write_study_section(std::ostream& to, const SceneReport& scene, const StudyReport& study,
                         const ReportOptions& options, int number)
{
    to << "<section class=\"study\"><h3>" << title_of(study.study)
       << "</h3>\n<p class=\"soft\">Truth: " << escaped(study.truth) << ".</p>\n"
       << "<ul class=\"judgement\">";
    for (const std::string& line : judgement(study, options))
        to << "<li>" << escaped(line) << "</li>";
    to << "</ul>\n";
    write_plot(to, scene, study, number);
    write_page_table(to, study);
    to << "</section>\n";
}

void write_page_head(std::ostream& to, const ReportOptions& options,
                     const ReportConditions& conditions)
{
    to << "<h1>Error against run time</h1>\n<p>Each scene is rendered in many ways. Every picture "
          "is held against the truth, and every way is timed.</p>\n<dl class=\"conditions\">"
       << "<dt>command</dt><dd><code>" << escaped(conditions.command) << "</code></dd>"
       << "<dt>processor</dt><dd>" << escaped(conditions.processor) << ", " << conditions.processors
       << " in use</dd><dt>compiler</dt><dd>" << escaped(conditions.compiler)
       << "</dd><dt>commit</dt><dd>" << escaped(conditions.commit)
       << "</dd><dt>times</dt><dd>medians of " << options.repetitions
       << " frames, taken in turns</dd></dl>\n";
}

void write_words(std::ostream& to, const std::vector<SceneReport>& scenes,
                 const ReportOptions& options)
{
    to << "<details><summary>How to read the tables and plots</summary><dl>"
          "<dt>spread</dt><dd>The width of the middle half of a run's times, over their "
          "median. In plots it is the bar through a point.</dd>"
          "<dt><b>bold</b> runs</dt><dd>They lie on the Pareto front: every run that is as exact "
          "is slower.</dd>"
          "<dt><i>slanted</i> runs</dt><dd>They perhaps lie on the front: another run is as exact, "
          "and the spreads of their times overlap.</dd>"
          "<dt>RMSE, max, PSNR</dt><dd>Errors of linear values, 1 for full, over all channels; "
          "PSNR "
          "for a peak of 1.</dd>"
          "<dt>pixels off</dt><dd>Pixels of which a channel differs by more than "
       << brief(options.threshold)
       << ".</dd><dt>where</dt><dd>Why pixels are off, by comparing ray trees with those of the "
          "reference, and how many are for each reason. In brackets, where no pixel is off, why "
          "the worst ones differ.</dd>";
    for (const ErrorShare& share : classes_of(scenes))
        to << "<dt>" << escaped(share.kind) << "</dt><dd>" << escaped(share.meaning) << ".</dd>";
    to << "</dl></details>\n";
}

std::string anchor_of(std::size_t scene)
{
    return "scene" + std::to_string(scene + 1);
}

void write_links(std::ostream& to, const std::vector<SceneReport>& scenes)
{
    if (scenes.size() < 2)
        return;
    to << "<nav>";
    for (std::size_t i = 0; i < scenes.size(); ++i)
        to << "<a href=\"#" << anchor_of(i) << "\">" << escaped(scenes[i].name) << "</a>";
    to << "</nav>\n";
}

}  // namespace

std::string report_html(const std::vector<SceneReport>& scenes, const ReportOptions& options,
                        const ReportConditions& conditions)
{
    std::ostringstream page;
    page << "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
            "<title>packtrace: error against run time</title>"
            "<link rel=\"icon\" href=\"data:,\"><style>"
         << page_style << "</style><script>" << page_begin_script << "</script></head><body>\n";
    write_page_head(page, options, conditions);
    write_words(page, scenes, options);
    write_links(page, scenes);
    int plots = 0;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const SceneReport& scene = scenes[i];
        page << "<section class=\"scene\" id=\"" << anchor_of(i) << "\"><h2>" << escaped(scene.name)
             << ", " << scene.width << " x " << scene.height << "</h2>\n";
        write_slider(page, scene);
        for (const StudyReport& study : scene.studies)
            write_study_section(page, scene, study, options, ++plots);
        page << "</section>\n";
    }
    page << "<script type=\"application/json\" id=\"pictures\">"
         << json_in_page(pictures_json(scenes)) << "</script>\n<script>" << page_script
         << "</script></body></html>\n";
    return page.str();
}

}  // namespace packtrace
