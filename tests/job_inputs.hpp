#pragma once

#include "run_program.hpp"

#include <string>
#include <vector>

// Inputs of jobs with several shards or ranks.
namespace packtrace::test {

/// A CSV of several blocks of rays, with a header, comments, blank lines and no line end after the
/// last line.
[[nodiscard]] inline std::string many_rays(int count)
{
    std::string text = "# rays\nox,oy,oz,dx,dy,dz\n";
    for (int i = 0; i < count; ++i) {
        text += std::to_string(0.01 * (i % 200) - 1.0) + ",0," + std::to_string(-(i % 7)) + ",0," +
                std::to_string(0.001 * (i % 300) - 0.1) + ",1\n";
        if (i % 1000 == 17)
            text += "\n# a comment\n";
    }
    text.pop_back();
    return text;
}

/// The first ray families of `stress`.
[[nodiscard]] inline std::vector<std::string> first_families(std::size_t count)
{
    const std::string list = run_packtrace({"stress", "--list"}).out;
    std::vector<std::string> families;
    for (std::size_t at = list.find('\n'); families.size() < count && at != std::string::npos;
         at = list.find('\n', at + 1)) {
        const std::string name = list.substr(at + 1, list.find(' ', at + 1) - at - 1);
        if (!name.empty() && name.front() != '-')
            families.push_back(name);
    }
    return families;
}

}  // namespace packtrace::test
