#pragma once

#include "run_program.hpp"

#include <filesystem>
#include <string>
#include <vector>

// Program runs that write files, for tests of what a failed run leaves behind.
namespace packtrace::test {

/// A run of the program, and the file that it writes.
struct Work {
    std::string name;
    std::string output;              ///< the last file it writes
    std::vector<std::string> words;  ///< `@` stands for the folder
    int longest = 60000;             ///< microseconds after which the run has ended, or nearly so
    bool holds_times = false;        ///< no two runs write the same bytes
};

[[nodiscard]] inline std::vector<Work> all_work()
{
    const std::string animated = PACKTRACE_SOURCE_DIR "/scenes/flight.scene";
    const auto render = [&](const std::string& scene, std::vector<std::string> words) {
        words.insert(words.begin(), {"render", scene, "--size", "160x120", "-q"});
        return words;
    };
    return {
        {"picture", "a.png", render(four_spheres_file, {"-o", "@a.png"})},
        {"frames", "a0003.pfm", render(animated, {"--frames", "0..3", "-o", "@a%04d.pfm"})},
        {"y4m", "a.y4m", render(animated, {"--frames", "0..3", "--y4m", "-o", "@a.y4m"})},
        {"intersect", "a.csv", {"intersect", four_spheres_file, "@rays", "-o", "@a.csv"}},
        {"report",
         "a/report.html",
         {"report", four_spheres_file, "--size", "24x18", "--quick", "--threads", "1", "-q",
          "--cache", "@cache", "-o", "@a"},
         1000000,
         true},
    };
}

[[nodiscard]] inline std::vector<std::string> words_of(const Work& work, const TempFolder& folder)
{
    std::vector<std::string> words = work.words;
    for (std::string& word : words)
        if (const std::size_t at = word.find('@'); at != std::string::npos)
            word.replace(at, 1, (folder / "").string());
    return words;
}

/// Writes the input of `intersect`, which is one of the works.
inline void write_rays(const TempFolder& folder)
{
    std::string text;
    for (int i = 0; i < 20000; ++i)
        text += "0,0,0," + std::to_string(i % 100 - 50) + ",0," + std::to_string(i % 37 + 1) + "\n";
    write_text(folder / "rays", text);
}

/// Whether a file has everything that an undisturbed run writes.
[[nodiscard]] inline bool is_whole(const Work& work, const std::string& text,
                                   const std::string& expected)
{
    return work.holds_times ? text.ends_with("</html>\n") && expected.ends_with("</html>\n")
                            : text == expected;
}

/// The number of unfinished files in the folder and its subfolders.
[[nodiscard]] inline std::size_t temporaries(const TempFolder& folder)
{
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / ""))
        count += std::size_t{entry.path().extension() == ".tmp"};
    return count;
}

}  // namespace packtrace::test
