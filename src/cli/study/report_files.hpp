#pragma once

#include <packtrace/write_report.hpp>

#include <filesystem>
#include <vector>

namespace packtrace::cli {

/// The files and folders of a report that its writing creates. They are removed again unless the
/// report is written as a whole. What was there before stays.
class ReportFiles {
public:
    /// Lists what is missing in `folder`, so call it before writing.
    ReportFiles(const std::vector<SceneReport>& reports, const std::filesystem::path& folder);
    ~ReportFiles();
    ReportFiles(const ReportFiles&) = delete;
    ReportFiles& operator=(const ReportFiles&) = delete;

    /// Call it after the last file is written.
    void keep();

private:
    void add_if_missing(const std::filesystem::path& name);
    void add_pictures(const SceneReport& report, const std::filesystem::path& folder);

    std::vector<std::filesystem::path> missing_;  ///< a folder follows what is in it
};

}  // namespace packtrace::cli
