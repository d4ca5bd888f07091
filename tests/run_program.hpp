#pragma once

#include "temp_folder.hpp"

#include <cstdlib>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace packtrace::test {

inline const std::string four_spheres_file = PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene";

struct ProgramResult {
    int exit_code = -1;  ///< -1 if it was killed
    std::string out;
    std::string err;
};

[[nodiscard]] inline std::string shell_quoted(const std::string& text)
{
    std::string quoted = "'";
    for (const char c : text)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// Runs a program with its arguments. `environment` (NAME=value words of the shell) precedes the
/// command; the file `input` is its standard input.
[[nodiscard]] inline ProgramResult run_command(const std::vector<std::string>& words,
                                               const std::string& environment = "",
                                               const std::string& input = "/dev/null")
{
    const TempFolder folder;
    std::string command = environment;
    for (const std::string& word : words)
        command += " " + shell_quoted(word);
    command += " >" + shell_quoted((folder / "out").string()) + " 2>" +
               shell_quoted((folder / "err").string()) + " <" + shell_quoted(input);

    ProgramResult result;
    const int status = std::system(command.c_str());
    if (WIFEXITED(status))
        result.exit_code = WEXITSTATUS(status);
    result.out = read_text(folder / "out");
    result.err = read_text(folder / "err");
    return result;
}

/// Runs the packtrace program likewise.
[[nodiscard]] inline ProgramResult run_packtrace(const std::vector<std::string>& arguments,
                                                 const std::string& environment = "",
                                                 const std::string& input = "/dev/null")
{
    std::vector<std::string> words{PACKTRACE_CLI};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_command(words, environment, input);
}

}  // namespace packtrace::test
