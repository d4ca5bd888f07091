#include "cli/study/report_files.hpp"

#include "lab/report/report_text.hpp"

#include <system_error>

namespace packtrace::cli {

ReportFiles::ReportFiles(const std::vector<SceneReport>& reports,
                         const std::filesystem::path& folder)
{
    for (const SceneReport& report : reports)
        add_pictures(report, folder);
    for (const char* const name : {"report.csv", "report.json", "report.html", "report.md"})
        add_if_missing(folder / name);
    const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
    // Of a/b/ the name is empty, and its parent is a/b.
    for (std::filesystem::path at = whole.has_filename() ? whole : whole.parent_path();
         at.has_relative_path(); at = at.parent_path())
        add_if_missing(at);
}

ReportFiles::~ReportFiles()
{
    std::error_code ignored;
    // Removes only empty folders.
    for (const std::filesystem::path& name : missing_)
        std::filesystem::remove(name, ignored);
}

void ReportFiles::keep()
{
    missing_.clear();
}

void ReportFiles::add_if_missing(const std::filesystem::path& name)
{
    std::error_code ignored;
    // A link that leads nowhere is there, too.
    if (!std::filesystem::exists(std::filesystem::symlink_status(name, ignored)))
        missing_.push_back(name);
}

void ReportFiles::add_pictures(const SceneReport& report, const std::filesystem::path& folder)
{
    for (const StudyReport& study : report.studies) {
        for (std::size_t i = 0; i < study.pictures.size(); ++i) {
            add_if_missing(folder / picture_file(report, study, i));
            add_if_missing(folder / error_file(report, study, i));
        }
        add_if_missing(folder / plot_file(report, study));
    }
    add_if_missing(folder / report.name);
}

}  // namespace packtrace::cli
