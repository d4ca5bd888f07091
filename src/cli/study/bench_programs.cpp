#include "cli/study/bench_programs.hpp"

#include "core/run_filter.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

namespace packtrace::cli {
namespace {

// One sample is the median of this many repetitions in a row.
constexpr const char* repetitions_of_a_run = "3";

// The descriptor for a program's figures, because standard output has its table.
constexpr int figures_descriptor = 3;

BenchFigures run_once(const std::string& program, const std::vector<std::string>& words)
{
    std::vector<std::string> command{program,
                                     "bench",
                                     "--repetitions",
                                     repetitions_of_a_run,
                                     "-o",
                                     "/dev/fd/" + std::to_string(figures_descriptor)};
    command.insert(command.end(), words.begin(), words.end());
    const FilterResult result = run_filter(command, "", figures_descriptor);
    if (!result.started)
        throw std::runtime_error(program + ": can't be run; give a packtrace program");
    if (result.exit_code != 0 || result.output.empty())
        throw std::runtime_error(program + ": its 'bench' fails; run it by hand to see why");
    BenchFigures figures = read_bench_text(result.output, program + ": its 'bench' answers");
    for (BenchLine& line : figures.lines)
        line.ratios = {line.ratio()};
    return figures;
}

// The lines that both programs have.
BenchFigures shared(BenchFigures figures, const BenchFigures& other)
{
    std::erase_if(figures.lines,
                  [&](const BenchLine& line) { return other.find(line.name) == nullptr; });
    return figures;
}

}  // namespace

BenchPairs run_in_pairs(const std::string& other, const std::vector<std::string>& words,
                        int repetitions)
{
    const std::string own = std::filesystem::read_symlink("/proc/self/exe").string();
    BenchPairs pairs;
    for (int i = 0; i < repetitions; ++i) {
        // The order alternates, so that a machine that warms up does not favour one program.
        BenchFigures first = run_once(i % 2 == 0 ? other : own, words);
        BenchFigures second = run_once(i % 2 == 0 ? own : other, words);
        if (i % 2 != 0)
            std::swap(first, second);
        pairs.before.add(shared(first, second));
        pairs.now.add(shared(second, first));
    }
    return pairs;
}

}  // namespace packtrace::cli
