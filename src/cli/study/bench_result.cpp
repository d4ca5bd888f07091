#include "cli/study/bench_result.hpp"

#include "cli/command.hpp"
#include "cli/output/text_table.hpp"

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <vector>

namespace packtrace::cli {
namespace {

std::string signed_percent(double share)
{
    return (share < 0.0 ? "" : "+") + fixed(100.0 * share, 1) + " %";
}

std::string interval_text(const Slowdown& slowdown)
{
    if (!slowdown.interval)
        return "too few repetitions";
    return signed_percent(slowdown.interval->low) + " to " +
           signed_percent(slowdown.interval->high);
}

const char* verdict_text(Verdict verdict)
{
    switch (verdict) {
        case Verdict::not_slower:
            return "no";
        case Verdict::slower:
            return "yes";
        case Verdict::cannot_tell:
            break;
    }
    return "can't tell";
}

// Prints the names of the lines with one verdict. Returns whether there are any.
bool name_lines(const BenchResult& result, Verdict wanted, const std::string& what)
{
    bool any = false;
    for (const BenchLine& line : result.figures.now.lines)
        if (result.verdict(line) == wanted) {
            any = true;
            std::cerr << what << line.name << ": " << interval_text(*result.slowdown(line))
                      << " against the baseline, with " << line.ratios.size() << " repetitions and "
                      << result.figures.before.find(line.name)->ratios.size()
                      << " of the baseline\n";
        }
    return any;
}

}  // namespace

std::optional<Slowdown> BenchResult::slowdown(const BenchLine& line) const
{
    const BenchLine* before = figures.before.find(line.name);
    if (before == nullptr)
        return std::nullopt;
    return paired ? paired_slowdown(line.ratios, before->ratios)
                  : unpaired_slowdown(line.ratios, before->ratios);
}

std::optional<Verdict> BenchResult::verdict(const BenchLine& line) const
{
    const std::optional<Slowdown> found = slowdown(line);
    return found ? std::optional(verdict_of(*found, limit)) : std::nullopt;
}

bool BenchResult::is_doubtful(const BenchLine& line) const
{
    const std::optional<Verdict> found = verdict(line);
    return found && *found != Verdict::not_slower;
}

bool BenchResult::has_doubts() const
{
    const std::vector<BenchLine>& lines = figures.now.lines;
    return std::any_of(lines.begin(), lines.end(),
                       [&](const BenchLine& line) { return is_doubtful(line); });
}

void print_bench_lines(const BenchResult& result)
{
    TextTable table(1, {"run", "ms", "of scalar single", "spread", "baseline", "slowdown",
                        "99 % interval", "slower"});
    const BenchFigures& now = result.figures.now;
    for (const BenchLine& reference : now.references)
        table.add({reference.name + " (the reference)",
                   fixed(1e3 * median_of(reference.seconds), 3), "1",
                   percent(relative_spread(reference.seconds), 1.0), "-", "-", "-", "-"});
    for (const BenchLine& line : now.lines) {
        std::vector<std::string> row{line.name, fixed(1e3 * median_of(line.seconds), 3),
                                     fixed(line.ratio(), 4),
                                     percent(relative_spread(line.ratios), 1.0)};
        if (const std::optional<Slowdown> slowdown = result.slowdown(line))
            row.insert(row.end(), {fixed(result.figures.before.find(line.name)->ratio(), 4),
                                   signed_percent(slowdown->estimate), interval_text(*slowdown),
                                   verdict_text(verdict_of(*slowdown, result.limit))});
        else
            row.insert(row.end(), {"-", "-", "-", "-"});
        table.add(row);
    }
    table.print(std::cout);
}

void end_with_verdict(const BenchResult& result, const std::string& baseline)
{
    const std::vector<BenchLine>& lines = result.figures.now.lines;
    if (std::none_of(lines.begin(), lines.end(),
                     [&](const BenchLine& line) { return result.slowdown(line).has_value(); }))
        throw std::runtime_error(baseline +
                                 ": has no line of what was measured; give the same scenes");
    const bool slower = name_lines(result, Verdict::slower, "slower: ");
    const bool unsure = name_lines(result, Verdict::cannot_tell, "can't tell: ");
    if (unsure)
        std::cerr << "more --repetitions, of the baseline too, or an idler machine would tell\n";
    if (slower || unsure)
        throw Failed{slower ? exit_failed : exit_unsure};
}

}  // namespace packtrace::cli
