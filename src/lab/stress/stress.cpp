#include "lab/stress/stress.hpp"

#include "lab/stress/evaluate.hpp"
#include "lab/stress/stress_measure.hpp"
#include "lab/stress/stress_subject.hpp"
#include "render/precision.hpp"
#include <packtrace/write_scene.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace packtrace::lab {
namespace {

/// Percentile of unsorted values; 0 for no values.
double percentile(std::vector<float>& values, double share)
{
    if (values.empty())
        return 0.0;
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
}

ErrorSpread spread_of(std::vector<float>& errors)
{
    return {percentile(errors, 0.5), percentile(errors, 0.99), percentile(errors, 1.0)};
}

/// The sum of `of(group)` over all groups, computed in parallel and added in order.
template <class Of>
auto sum_of_groups(std::size_t groups, const Of& of)
{
    std::vector<decltype(of(groups))> by_group(groups);
    tbb::parallel_for(std::size_t{0}, groups, [&](std::size_t g) { by_group[g] = of(g); });
    decltype(of(groups)) sum;
    for (const auto& some : by_group)
        sum.add(some);
    return sum;
}

template <class Real>
Errors evaluate_run(const StressGroup& group, const StressRun& run)
{
    Evaluation evaluation(roundoff_of<Real>);
    for (std::size_t i = 0; i < group.rays.size(); ++i)
        evaluate_ray(evaluation, group, run, i);
    return evaluation.errors();
}

template <class Real>
Errors evaluate_runs(const std::vector<StressGroup>& groups, const std::vector<StressRun>& runs)
{
    return sum_of_groups(groups.size(),
                         [&](std::size_t g) { return evaluate_run<Real>(groups[g], runs[g]); });
}

/// Records the first wrong answer: a wrong decision if there is one, else a wrong t, normal or
/// other value.
template <class Real>
void add_example(StressRow& row, const std::vector<StressGroup>& groups,
                 const std::vector<StressRun>& runs)
{
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (std::size_t i = 0; i < groups[g].rays.size(); ++i) {
            Evaluation one(roundoff_of<Real>);
            evaluate_ray(one, groups[g], runs[g], i);
            const char* fault = fault_of(one.errors());
            if (*fault == '\0' || (one.errors().wrong() == 0 && row.wrong > 0))
                continue;
            row.example = example_text(groups[g], g, i, runs[g].answers[i], fault);
            row.example_scene = scene_text(groups[g].scene);
            row.example_ray = csv_of(groups[g].rays[i]);
            return;
        }
}

StressRow row_of(const StressSubject& subject, Precision precision, Errors errors, double seconds)
{
    StressRow row;
    static_cast<ErrorCounts&>(row) = errors;
    row.precision = precision;
    row.kernel = subject.kernel;
    row.isa = subject.isa;
    const bool doubles = row.precision == Precision::double_ && subject.kernel == "packet";
    row.mode = doubles ? "any" : subject.mode;
    row.held = doubles || subject.exact;
    row.wrong = errors.wrong();
    row.ulp = spread_of(errors.ulp);
    row.normal = spread_of(errors.normal);
    row.ns = seconds * 1e9 / static_cast<double>(std::max<std::uint64_t>(errors.rays, 1));
    return row;
}

template <class Real>
void add_second_hits(StressRow& row, const StressSubject& subject,
                     const std::vector<StressGroup>& groups, SelfHits rule)
{
    SecondHits sum = sum_of_groups(groups.size(), [&](std::size_t g) {
        return trace_second_hits<Real>(subject, groups[g], rule);
    });
    row.second_rays = sum.rays;
    row.self_hits = sum.taken;
    row.second_lost = sum.lost;
    row.second_inexact = sum.inexact;
    row.second = spread_of(sum.errors);
}

template <class Real>
void add_bounds(StressRow& row, const StressSubject& subject,
                const std::vector<StressGroup>& groups)
{
    BoundChecks sum = sum_of_groups(
        groups.size(), [&](std::size_t g) { return check_bounds<Real>(subject, groups[g]); });
    row.bounds = sum.bounds;
    row.bounds_missed = sum.missed;
    row.bounds_ulp = spread_of(sum.ulp);
}

template <class Real>
StressRow row_of(const StressSubject& subject, const std::vector<StressGroup>& groups,
                 const std::vector<StressRun>& runs)
{
    double seconds = 0.0;
    for (const StressRun& run : runs)
        seconds += run.seconds;
    return row_of(subject, precision_of<Real>, evaluate_runs<Real>(groups, runs), seconds);
}

/// The subjects with packet kernels.
std::vector<StressSubject> packets_of(std::vector<StressSubject> subjects)
{
    std::erase_if(subjects, [](const auto& subject) { return subject.kernel != "packet"; });
    return subjects;
}

/// Adds a row for the result of `ask` for each subject. Instruction sets with the `same` answers
/// share a row.
template <class Ask, class Same, class MakeRow>
void add_distinct_rows(const std::vector<StressSubject>& subjects, Precision precision,
                       const Ask& ask, const Same& same, const MakeRow& make_row,
                       std::vector<StressRow>& rows)
{
    std::vector<std::pair<std::size_t, decltype(ask(subjects[0]))>> answered;
    for (const StressSubject& subject : subjects) {
        // Packets of doubles are the same in every mode: one mode stands for all.
        const bool in_any_mode = precision == Precision::double_ && subject.kernel == "packet";
        if (in_any_mode && subject.mode != subjects.back().mode)
            continue;
        auto run = ask(subject);
        const auto twin = std::find_if(answered.begin(), answered.end(), [&](const auto& other) {
            const StressRow& row = rows[other.first];
            return row.kernel == subject.kernel && (row.mode == subject.mode || in_any_mode) &&
                   same(run, other.second);
        });
        if (twin != answered.end()) {
            rows[twin->first].isa += " " + subject.isa;
            continue;
        }
        rows.push_back(make_row(subject, run));
        answered.emplace_back(rows.size() - 1, std::move(run));
    }
}

/// The row of one subject's answers to a family's rays.
template <class Real>
StressRow row_of(const StressFamily& family, const StressOptions& options,
                 const StressSubject& subject, const std::vector<StressGroup>& groups,
                 const std::vector<StressRun>& runs)
{
    StressRow row = row_of<Real>(subject, groups, runs);
    row.family = family.name;
    if (options.second_hits)
        add_second_hits<Real>(row, subject, groups, options.self_hits);
    add_example<Real>(row, groups, runs);
    if (!row.held)
        return row;
    if (options.bounds)
        add_bounds<Real>(row, subject, groups);
    row.faults = faults_of(row);
    return row;
}

template <class Real>
void add_rows(const StressFamily& family, const StressOptions& options,
              const std::vector<StressSubject>& subjects, std::vector<StressRow>& rows)
{
    const std::vector<StressGroup> groups = make_groups<Real>(family, options.seed, options.rays);
    const auto ask = [&](const StressSubject& subject) {
        std::vector<StressRun> runs;
        run_alone(options.alone, [&] {
            for (const StressGroup& group : groups)
                runs.push_back(run_subject<Real>(subject, group));
        });
        return runs;
    };
    const auto same = [](const std::vector<StressRun>& a, const std::vector<StressRun>& b) {
        return std::equal(a.begin(), a.end(), b.begin(), same_answers);
    };
    add_distinct_rows(
        family.packets_only ? packets_of(subjects) : subjects, precision_of<Real>, ask, same,
        [&](const StressSubject& subject, const std::vector<StressRun>& runs) {
            return row_of<Real>(family, options, subject, groups, runs);
        },
        rows);
}

/// Whether `a` is better than `b` in wrong answers, error or time, and worse in none.
bool dominates(const StressRow& a, const StressRow& b)
{
    const bool not_worse = a.wrong <= b.wrong && a.ulp.p99 <= b.ulp.p99 && a.ns <= b.ns;
    return not_worse && (a.wrong < b.wrong || a.ulp.p99 < b.ulp.p99 || a.ns < b.ns);
}

/// Rows compete within one precision, as errors count in its ulps.
void mark_pareto(std::vector<StressRow>& rows)
{
    for (StressRow& row : rows)
        row.pareto = std::none_of(rows.begin(), rows.end(), [&](const StressRow& other) {
            return other.precision == row.precision && dominates(other, row);
        });
}

/// The rows of one measure in one precision.
void add_measured(const StressMeasure& measure, const StressOptions& options, Precision precision,
                  const std::vector<StressSubject>& subjects, std::vector<StressRow>& rows)
{
    const auto same = [](const MeasureRun& a, const MeasureRun& b) {
        return a.answers == b.answers;
    };
    const auto make_row = [&](const StressSubject& subject, const MeasureRun& run) {
        StressRow row = row_of(subject, precision, run.errors, run.seconds);
        row.family = measure.name;
        if (row.held)
            row.faults = faults_of_measure(row);
        return row;
    };
    add_distinct_rows(packets_of(subjects), precision, measure.prepare(precision, options), same,
                      make_row, rows);
}

void check_families(const StressOptions& options)
{
    const auto families = list_stress_families();
    for (const std::string& name : options.families)
        if (std::none_of(families.begin(), families.end(),
                         [&](const StressFamilyInfo& family) { return family.name == name; }))
            throw std::invalid_argument("no family is called '" + name + "'");
}

}  // namespace

void run_stress(const StressOptions& options,
                const std::function<void(const std::vector<StressRow>&)>& take)
{
    check_families(options);
    const std::vector<StressSubject> subjects = stress_subjects(options);
    const std::vector<std::string> chosen = chosen_families(options);
    const auto mine = [&](const std::string& name) {
        return std::find(chosen.begin(), chosen.end(), name) != chosen.end();
    };
    for (const StressFamily& family : stress_families()) {
        if (!mine(family.name))
            continue;
        std::vector<StressRow> rows;
        for (const Precision precision : packet_precisions)
            if (wanted(options.precisions, precision))
                with_packet_real(precision, [&]<class Real>() {
                    add_rows<Real>(family, options, subjects, rows);
                });
        mark_pareto(rows);
        take(rows);
    }
    for (const StressMeasure& measure : stress_measures()) {
        if (!mine(measure.name))
            continue;
        std::vector<StressRow> rows;
        for (const Precision precision : packet_precisions)
            if (wanted(options.precisions, precision))
                add_measured(measure, options, precision, subjects, rows);
        mark_pareto(rows);
        take(rows);
    }
}

std::vector<std::string> chosen_families(const StressOptions& options)
{
    std::vector<std::string> chosen;
    int from_first = -options.first_family;
    for (const StressFamilyInfo& family : list_stress_families()) {
        if (!wanted(options.families, family.name))
            continue;
        if (from_first >= 0 && from_first % options.family_step == 0)
            chosen.push_back(family.name);
        ++from_first;
    }
    return chosen;
}

std::vector<StressOptions> stress_parts(const StressOptions& options)
{
    check_families(options);
    std::vector<StressOptions> parts;
    for (const StressFamilyInfo& family : list_stress_families())
        for (const Precision precision : packet_precisions) {
            if (!wanted(options.families, family.name) || !wanted(options.precisions, precision))
                continue;
            StressOptions part = options;
            part.families = {family.name};
            part.precisions = {precision};
            parts.push_back(part);
        }
    return parts;
}

std::vector<StressMeasure> stress_measures()
{
    std::vector<StressMeasure> all = power_measures();
    all.push_back(glass_measure());
    for (StressMeasure& measure : tree_measures())
        all.push_back(std::move(measure));
    return all;
}

std::vector<StressFamilyInfo> list_stress_families()
{
    std::vector<StressFamilyInfo> list;
    for (const StressFamily& family : stress_families())
        list.push_back({family.name, family.what});
    for (const StressMeasure& measure : stress_measures())
        list.push_back({measure.name, measure.what});
    return list;
}

}  // namespace packtrace::lab
