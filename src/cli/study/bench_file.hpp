#pragma once

#include "lab/bench/paired_bench.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace packtrace::cli {

/// What `bench` measured: the lines of all scenes, and what they are compared to.
struct BenchFigures {
    std::vector<BenchLine> lines;
    std::vector<BenchLine> references;          ///< one a scene
    std::string picture;                        ///< its options; empty where a file has none
    std::map<std::string, std::string> scenes;  ///< by name, a checksum; empty likewise

    /// The samples of a line; null when there is no line of that name.
    [[nodiscard]] const BenchLine* find(const std::string& name) const;
    /// Adds samples to those of the lines of the same names.
    void add(const BenchFigures& more);
};

/// The text of a file that a later run takes as its baseline.
[[nodiscard]] std::string bench_text(const BenchFigures& figures);

/// What such a text says, whatever version wrote it; `name` is for messages. Throws
/// std::runtime_error, in one line, for any other.
[[nodiscard]] BenchFigures read_bench_text(const std::string& text, const std::string& name);
[[nodiscard]] BenchFigures read_bench_file(const std::filesystem::path& file);

}  // namespace packtrace::cli
