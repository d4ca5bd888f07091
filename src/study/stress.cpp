#include "study/stress.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <tbb/parallel_for.h>

#include "study/self_hits.hpp"
#include "study/stress_bounds.hpp"
#include "study/stress_measure.hpp"
#include "study/stress_subject.hpp"

namespace packtrace::study {
namespace {

/// Scenes of a family.
constexpr int group_count = 16;

template <class Real>
StressGroup make_group(const StressFamily& family, std::uint64_t seed, int rays)
{
    StressRandom random(seed);
    StressCase one = family.make(random);
    StressGroup group;
    group.scene = std::move(one.scene);
    round_to_precision<Real>(group.scene);
    for (const Object& object : group.scene.objects)
        group.surfaces.emplace_back(object, static_cast<std::int32_t>(group.surfaces.size()));
    for (int i = 0; i < rays; ++i) {
        StressRay ray = one.ray(random);
        round_to_precision<Real>(ray);
        std::vector<Meeting> meetings;
        for (const WideSurface& surface : group.surfaces)
            find_meetings(surface, ray, meetings);
        group.rays.push_back(ray);
        group.meetings.push_back(std::move(meetings));
    }
    return group;
}

/// The same scenes and rays whatever else is run: they follow from seed and family alone.
template <class Real>
std::vector<StressGroup> make_groups(const StressFamily& family, const StressOptions& options)
{
    StressRandom random(options.seed);
    std::uint64_t mixed = random.bits();
    for (const char letter : family.name)
        mixed = StressRandom(mixed ^ static_cast<unsigned char>(letter)).bits();
    std::vector<StressGroup> groups(group_count);
    tbb::parallel_for(0, group_count, [&](int i) {
        const int rays = options.rays / group_count + (i < options.rays % group_count ? 1 : 0);
        groups[static_cast<std::size_t>(i)] =
            make_group<Real>(family, mixed + static_cast<std::uint64_t>(i), rays);
    });
    return groups;
}

bool same_answers(const StressRun& a, const StressRun& b)
{
    return std::equal(a.answers.begin(), a.answers.end(), b.answers.begin(), b.answers.end(),
                      [](const Answer& x, const Answer& y) {
                          return x.object == y.object && x.t == y.t &&
                                 (x.object < 0 || x.normal == y.normal);
                      });
}

/// Percentile of unsorted values, 0 of none.
double percentile(std::vector<float>& values, double share)
{
    if (values.empty())
        return 0.0;
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
}

template <class Real>
Errors judge_runs(const std::vector<StressGroup>& groups, const std::vector<StressRun>& runs)
{
    std::vector<Errors> by_group(groups.size());
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
        Judge judge(groups[g].surfaces, std::numeric_limits<Real>::epsilon() / 2.0);
        for (std::size_t i = 0; i < groups[g].rays.size(); ++i)
            judge.judge(groups[g].rays[i], groups[g].meetings[i], runs[g].answers[i]);
        by_group[g] = judge.errors();
    });
    Errors sum;
    for (const Errors& errors : by_group)
        sum.add(errors);
    return sum;
}

StressRow row_of(const StressSubject& subject, const char* precision, Errors errors, double seconds)
{
    StressRow row;
    row.precision = precision;
    row.kernel = subject.kernel;
    row.mode = subject.mode;
    row.isa = subject.isa;
    row.rays = errors.rays;
    row.hits = errors.hits;
    row.undecidable = errors.undecidable;
    row.wrong = errors.wrong;
    row.wrong_in_band = errors.wrong_in_band;
    row.not_finite = errors.not_finite;
    row.ulp_median = percentile(errors.ulp, 0.5);
    row.ulp_p99 = percentile(errors.ulp, 0.99);
    row.ulp_max = percentile(errors.ulp, 1.0);
    row.rho = errors.rho;
    row.distance = errors.distance;
    row.normal = errors.normal;
    row.relative = errors.relative;
    row.ns = seconds * 1e9 / static_cast<double>(std::max<std::uint64_t>(errors.rays, 1));
    return row;
}

template <class Real>
SelfHitCounts self_hits_of(const StressSubject& subject, const std::vector<StressGroup>& groups,
                           SelfHits rule)
{
    std::vector<SelfHitCounts> by_group(groups.size());
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
        by_group[g] = count_self_hits<Real>(subject, groups[g], rule);
    });
    SelfHitCounts sum;
    for (const SelfHitCounts& counts : by_group)
        sum.add(counts);
    return sum;
}

template <class Real>
void add_self_hits(StressRow& row, const StressSubject& subject,
                   const std::vector<StressGroup>& groups)
{
    const SelfHitCounts note = self_hits_of<Real>(subject, groups, SelfHits::note);
    const SelfHitCounts exact = self_hits_of<Real>(subject, groups, SelfHits::exact);
    row.secondary = note.rays;
    row.note_taken = note.taken;
    row.note_lost = note.lost;
    row.exact_taken = exact.taken;
    row.exact_lost = exact.lost;
}

template <class Real>
StressRow row_of(const StressSubject& subject, const std::vector<StressGroup>& groups,
                 const std::vector<StressRun>& runs)
{
    double seconds = 0.0;
    for (const StressRun& run : runs)
        seconds += run.seconds;
    return row_of(subject, sizeof(Real) == sizeof(float) ? "single" : "double",
                  judge_runs<Real>(groups, runs), seconds);
}

/// Whether `runs` are, bit for bit, those of the last row of the same kernel and mode.
struct Judged {
    std::size_t row;
    std::vector<StressRun> runs;
};

template <class Real>
void add_rows(const StressFamily& family, const StressOptions& options,
              const std::vector<StressSubject>& subjects, std::vector<StressRow>& rows)
{
    const std::vector<StressGroup> groups = make_groups<Real>(family, options);
    std::vector<Judged> judged;
    for (const StressSubject& subject : subjects) {
        // Packets of doubles are the same in every mode.
        const bool packet_of_doubles = sizeof(Real) == sizeof(double) && subject.kernel == "packet";
        if (packet_of_doubles && subject.mode != subjects.back().mode)
            continue;
        std::vector<StressRun> runs;
        for (const StressGroup& group : groups)
            runs.push_back(run_subject<Real>(subject, group));
        const auto twin = std::find_if(judged.begin(), judged.end(), [&](const Judged& other) {
            const StressRow& row = rows[other.row];
            return row.kernel == subject.kernel &&
                   (row.mode == subject.mode || packet_of_doubles) &&
                   std::equal(runs.begin(), runs.end(), other.runs.begin(), same_answers);
        });
        if (twin != judged.end()) {
            rows[twin->row].isa += " " + subject.isa;
            continue;
        }
        rows.push_back(row_of<Real>(subject, groups, runs));
        add_self_hits<Real>(rows.back(), subject, groups);
        rows.back().family = family.name;
        if (packet_of_doubles)
            rows.back().mode = "any";
        rows.back().broken = broken_bounds(rows.back());
        judged.push_back({rows.size() - 1, std::move(runs)});
    }
}

/// Whether a is nowhere worse than b, and somewhere better, in wrong answers, error and time.
bool dominates(const StressRow& a, const StressRow& b)
{
    const bool not_worse = a.wrong <= b.wrong && a.ulp_p99 <= b.ulp_p99 && a.ns <= b.ns;
    return not_worse && (a.wrong < b.wrong || a.ulp_p99 < b.ulp_p99 || a.ns < b.ns);
}

/// Of each precision, as their errors count in units of their own.
void mark_pareto(std::vector<StressRow>& rows)
{
    for (StressRow& row : rows)
        row.pareto = std::none_of(rows.begin(), rows.end(), [&](const StressRow& other) {
            return other.precision == row.precision && dominates(other, row);
        });
}

/// The rows of one measure in one precision; instruction sets with the same answers share one.
void add_measured(const StressMeasure& measure, const char* precision,
                  const StressMeasure::Ask& ask, const std::vector<StressSubject>& subjects,
                  std::vector<StressRow>& rows)
{
    const bool doubles = precision[0] == 'd';
    std::vector<std::pair<std::size_t, std::vector<double>>> answered;
    for (const StressSubject& subject : subjects) {
        if (subject.kernel != "packet" || (doubles && subject.mode != subjects.back().mode))
            continue;
        MeasureRun run = ask(subject);
        const auto twin = std::find_if(answered.begin(), answered.end(), [&](const auto& other) {
            return (rows[other.first].mode == subject.mode || doubles) &&
                   other.second == run.answers;
        });
        if (twin != answered.end()) {
            rows[twin->first].isa += " " + subject.isa;
            continue;
        }
        rows.push_back(row_of(subject, precision, std::move(run.errors), run.seconds));
        rows.back().family = measure.name;
        if (doubles)
            rows.back().mode = "any";
        rows.back().broken = broken_bounds(rows.back());
        answered.emplace_back(rows.size() - 1, std::move(run.answers));
    }
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
    for (const StressFamily& family : stress_families()) {
        if (!wanted(options.families, family.name))
            continue;
        std::vector<StressRow> rows;
        if (wanted(options.precisions, "single"))
            add_rows<float>(family, options, subjects, rows);
        if (wanted(options.precisions, "double"))
            add_rows<double>(family, options, subjects, rows);
        mark_pareto(rows);
        take(rows);
    }
    for (const StressMeasure& measure : stress_measures()) {
        if (!wanted(options.families, measure.name))
            continue;
        std::vector<StressRow> rows;
        if (wanted(options.precisions, "single"))
            add_measured(measure, "single", measure.in_single(options), subjects, rows);
        if (wanted(options.precisions, "double"))
            add_measured(measure, "double", measure.in_double(options), subjects, rows);
        mark_pareto(rows);
        take(rows);
    }
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

}  // namespace packtrace::study
