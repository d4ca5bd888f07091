// Any bytes as a baseline of bench give numbers whose text reads back, or an error.
#include "cli/study/bench_file.hpp"
#include "input_file.hpp"

#include <stdexcept>

PACKTRACE_FUZZER(baselines)
{
    using namespace packtrace;
    const fuzz::InputFile file(bytes);
    cli::BenchFigures figures;
    try {
        figures = cli::read_bench_file(file.name());
    } catch (const std::runtime_error&) {
        return;
    }
    const std::string text = cli::bench_text(figures);
    const auto* const data = reinterpret_cast<const std::uint8_t*>(text.data());
    const fuzz::InputFile written({data, text.size()});
    const cli::BenchFigures again = cli::read_bench_file(written.name());
    fuzz::require(again.lines.size() == figures.lines.size(), "a baseline reads back whole");
}
