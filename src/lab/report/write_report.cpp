#include "core/atomic_file.hpp"
#include "lab/report/report_pictures.hpp"
#include "lab/report/report_text.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/write_report.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace packtrace {
namespace {

void write_pictures(const SceneReport& scene, const StudyReport& study,
                    const std::filesystem::path& folder)
{
    for (std::size_t i = 0; i < study.pictures.size(); ++i) {
        write_image(folder / picture_file(scene, study, i),
                    convert<float>(study.pictures[i].image));
        if (i > 0)
            write_image(folder / error_file(scene, study, i), error_map_with_legend(study, i));
    }
}

// The report's own files.
constexpr const char* csv_file = "report.csv";
constexpr const char* json_file = "report.json";
constexpr const char* html_file = "report.html";
constexpr const char* markdown_file = "report.md";

/// Checks that each scene has a folder name of its own, and that each study has a truth.
void check_scenes(const std::vector<SceneReport>& scenes)
{
    std::set<std::string> taken;
    for (const SceneReport& scene : scenes) {
        if (scene.name != report_folder_name(scene.name) || !taken.insert(scene.name).second)
            throw std::invalid_argument("report: a scene is called '" + scene.name +
                                        "', which can't be its folder; see report_folder_name()");
        const auto has_truth = [](const StudyReport& study) { return !study.pictures.empty(); };
        if (scene.studies.empty() ||
            !std::all_of(scene.studies.begin(), scene.studies.end(), has_truth))
            throw std::invalid_argument("report: '" + scene.name +
                                        "' has a study without pictures, or none at all; take "
                                        "what report() returns");
    }
}

}  // namespace

std::string report_folder_name(const std::string& name)
{
    constexpr std::size_t longest = 200;  // with room for a number
    std::string result = language::escape(name);
    for (char& c : result)
        if (c == '/' || c == '\\')
            c = '_';
    std::size_t end = std::min(result.size(), longest);
    // Do not cut a character of several bytes.
    while (end < result.size() && (static_cast<unsigned char>(result[end]) & 0xC0u) == 0x80u)
        --end;
    result.resize(end);
    if (result.empty() || result[0] == '.')
        result.insert(0, "_");
    for (const char* own : {csv_file, json_file, html_file, markdown_file})
        if (result == own)
            result += '_';
    return result;
}

void write_report(const std::vector<SceneReport>& scenes, const ReportOptions& options,
                  const ReportConditions& conditions, const std::filesystem::path& folder)
{
    check_scenes(scenes);
    make_folders(folder);
    for (const SceneReport& scene : scenes) {
        make_folders(folder / scene.name);
        for (const StudyReport& study : scene.studies) {
            write_pictures(scene, study, folder);
            write_file(folder / plot_file(scene, study), report_plot(scene, study));
        }
    }
    write_file(folder / csv_file, report_csv(scenes));
    write_file(folder / json_file, report_json(scenes, options, conditions));
    write_file(folder / html_file, report_html(scenes, options, conditions));
    write_file(folder / markdown_file, report_markdown(scenes, options, conditions));
}

}  // namespace packtrace
