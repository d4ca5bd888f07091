#pragma once

#include "core/run_filter.hpp"
#include "run_program.hpp"

#include <cstdlib>
#include <string>

// Opens pages that the program writes in a real browser without a window.
namespace packtrace::test {

/// The browser's name along PATH; empty if there is none.
[[nodiscard]] inline std::string browser()
{
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
        if (const FilterResult run = run_filter({name, "--version"}, "");
            run.started && run.exit_code == 0)
            return name;
    return {};
}

struct PageResult {
    std::string dom;      ///< the document after the page's scripts have run
    std::string console;  ///< messages of the page's scripts, including errors
};

/// Opens a file without the browser's sandbox, which does not run as root or in containers.
[[nodiscard]] inline PageResult open_page(const std::string& name, const TempFolder& folder,
                                          const std::string& file)
{
    const std::string profile = shell_quoted((folder / "profile").string());
    const std::string command =
        name +
        " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --window-size=1280,2000"
        " --enable-logging=stderr --virtual-time-budget=20000 --user-data-dir=" +
        profile + " --dump-dom " + shell_quoted("file://" + file) + " >" +
        shell_quoted((folder / "dom").string()) + " 2>" + shell_quoted((folder / "log").string());
    PageResult result;
    if (std::system(command.c_str()) != 0)
        return result;
    result.dom = read_text(folder / "dom");
    const std::string log = read_text(folder / "log");
    for (std::size_t at = 0; at < log.size();) {
        const std::size_t end = std::min(log.find('\n', at), log.size());
        const std::string line = log.substr(at, end - at);
        if (line.find("CONSOLE") != std::string::npos)
            result.console += line + "\n";
        at = end + 1;
    }
    return result;
}

}  // namespace packtrace::test
