#include "lab/report/report_study.hpp"
#include <packtrace/report.hpp>

#include <algorithm>

namespace packtrace {
namespace {

bool is_as_exact(const ReportRun& run, const ReportRun& than)
{
    return run.error.rmse <= than.error.rmse;
}

// Whether a run may take another one's place on the front: it is as exact and not surely slower.
bool may_beat(const ReportRun& run, const ReportRun& other)
{
    return is_as_exact(run, other) && !surely_faster(other, run);
}

Pareto standing_of(const ReportRun& run, const std::vector<ReportRun>& runs)
{
    Pareto standing = Pareto::on_front;
    for (const ReportRun& other : runs) {
        if (&other == &run)
            continue;
        if (is_as_exact(other, run) && surely_faster(other, run))
            return Pareto::beaten;
        if (may_beat(other, run))
            standing = Pareto::undecided;
    }
    return standing;
}

bool is_quicker(const ReportRun& run, const ReportRun* best)
{
    return best == nullptr || run.median < best->median;
}

// More exact, or as exact and faster.
bool is_better(const ReportRun& run, const ReportRun* best)
{
    return best == nullptr || run.error.rmse < best->error.rmse ||
           (run.error.rmse == best->error.rmse && run.median < best->median);
}

}  // namespace

Interval middle_times(const ReportRun& run)
{
    if (run.seconds.empty())
        return {run.median, run.median};
    return {quantile(run.seconds, 0.25), quantile(run.seconds, 0.75)};
}

bool surely_faster(const ReportRun& run, const ReportRun& other)
{
    // One time has no spread.
    return run.seconds.size() != 1 && middle_times(run).high < middle_times(other).low;
}

void mark_pareto(std::vector<ReportRun>& runs)
{
    for (ReportRun& run : runs)
        run.pareto = standing_of(run, runs);
}

RunChoice cheapest_within(const StudyReport& study, double error)
{
    RunChoice choice;
    for (const ReportRun& run : study.runs)
        if (run.error.rmse <= error && is_quicker(run, choice.run))
            choice.run = &run;
    for (const ReportRun& run : study.runs)
        if (choice.run != nullptr && &run != choice.run && run.error.rmse <= error &&
            !surely_faster(*choice.run, run))
            choice.undecided.push_back(&run);
    return choice;
}

RunChoice most_exact_within(const StudyReport& study, double seconds)
{
    RunChoice choice;
    for (const ReportRun& run : study.runs)
        if (middle_times(run).high <= seconds && is_better(run, choice.run))
            choice.run = &run;
    for (const ReportRun& run : study.runs) {
        const Interval times = middle_times(run);
        if (times.low <= seconds && seconds < times.high &&
            (choice.run == nullptr || run.error.rmse < choice.run->error.rmse))
            choice.undecided.push_back(&run);
    }
    return choice;
}

}  // namespace packtrace
