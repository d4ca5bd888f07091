#pragma once

#include "lab/bench/paired_bench.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace packtrace::cli {

/// The results of `bench`: the lines of all scenes, and the references.
struct BenchFigures {
    std::vector<BenchLine> lines;
    std::vector<BenchLine> references;          ///< one per scene
    std::string picture;                        ///< options of the picture; empty for old files
    std::map<std::string, std::string> scenes;  ///< checksums by name; empty for old files

    /// The line with this name; null if there is none.
    [[nodiscard]] const BenchLine* find(const std::string& name) const;
    /// Adds samples to the lines with equal names.
    void add(const BenchFigures& more);
};

/// The text of a baseline file for later runs.
[[nodiscard]] std::string bench_text(const BenchFigures& figures);

/// Reads the text of a baseline file of any version. `name` is for messages. Throws
/// std::runtime_error, with one line, for other text.
[[nodiscard]] BenchFigures read_bench_text(const std::string& text, const std::string& name);
[[nodiscard]] BenchFigures read_bench_file(const std::filesystem::path& file);

}  // namespace packtrace::cli
