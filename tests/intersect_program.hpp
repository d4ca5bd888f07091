#pragma once

#include "fork_child.hpp"
#include "run_program.hpp"
#include "temp_folder.hpp"

#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace packtrace::test {

/// A scene whose hits can be computed by hand: the unit sphere "ball" at (0, 0, 5), the plane
/// "floor, tiled" at y = -2, the capped unit cylinder "can" at (10, 0, 0) along z from -1 to 1.
inline constexpr const char* hand_scene = R"(
sphere { name = "ball"  center = (0, 0, 5)  radius = 1  color = (255, 0, 0) }
plane { name = "floor, tiled"  point = (0, -2, 0)  normal = (0, 1, 0)  color = (255, 0, 0) }
cylinder { name = "can"  z_range = (-1, 1)  capped = true  translate = (10, 0, 0)
           color = (255, 0, 0) }
)";

/// Runs `packtrace intersect` on `hand_scene` and the rays in this text.
[[nodiscard]] inline ProgramResult intersect(const std::string& rays,
                                             const std::vector<std::string>& more = {})
{
    const TempFolder folder;
    write_text(folder / "hand.scene", hand_scene);
    write_text(folder / "rays.csv", rays);
    std::vector<std::string> words{"intersect", (folder / "hand.scene").string(),
                                   (folder / "rays.csv").string()};
    words.insert(words.end(), more.begin(), more.end());
    ProgramResult result = run_packtrace(words);
    // Messages contain the file's path, which changes from run to run.
    const std::string place = (folder / "").string();
    if (result.err.starts_with(place))
        result.err.erase(0, place.size());
    return result;
}

/// Result of a shell command that runs `packtrace` with `words`, which may include redirections:
/// its exit code and its peak memory in KiB.
struct ShellResult {
    int exit_code = -1;
    long peak_memory = 0;
};

[[nodiscard]] inline ShellResult run_in_shell(const std::string& words)
{
    const std::string command = "exec " + shell_quoted(PACKTRACE_CLI) + " " + words;
    const pid_t child = fork_child(
        [&] { execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr)); });
    int status = 0;
    rusage usage{};
    ShellResult result;
    if (wait4(child, &status, 0, &usage) == child && WIFEXITED(status))
        result = {WEXITSTATUS(status), usage.ru_maxrss};
    return result;
}

}  // namespace packtrace::test
