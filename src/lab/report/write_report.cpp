#include <packtrace/write_report.hpp>

#include <system_error>

#include <packtrace/image_io.hpp>

#include "core/atomic_file.hpp"
#include "lab/report/report_pictures.hpp"
#include "lab/report/report_text.hpp"

namespace packtrace {
namespace {

void write_text(const std::filesystem::path& file, const std::string& text)
{
    AtomicFile output(file);
    output.write(std::string_view(text));
    output.commit();
}

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

}  // namespace

void write_report(const std::vector<SceneReport>& scenes, const ReportOptions& options,
                  const ReportConditions& conditions, const std::filesystem::path& folder)
{
    for (const SceneReport& scene : scenes) {
        // A folder that can't be made shows when a file is written into it.
        std::error_code ignored;
        std::filesystem::create_directories(folder / scene.name, ignored);
        for (const StudyReport& study : scene.studies) {
            write_pictures(scene, study, folder);
            write_text(folder / plot_file(scene, study), report_plot(scene, study));
        }
    }
    write_text(folder / "report.csv", report_csv(scenes));
    write_text(folder / "report.json", report_json(scenes, options, conditions));
    write_text(folder / "report.html", report_html(scenes, options, conditions));
    write_text(folder / "report.md", report_markdown(scenes, options, conditions));
}

}  // namespace packtrace
