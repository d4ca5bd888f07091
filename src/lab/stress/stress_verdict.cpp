#include "core/text.hpp"
#include "lab/stress/stress.hpp"
#include "render/option_words.hpp"

#include <algorithm>
#include <set>

namespace packtrace::lab {
namespace {

/// What 99 of 100 normals are within.
constexpr double normal_bound = 1e-6;

/// What errors are within, of what the inputs' rounding makes, where no ulp are counted.
constexpr int rho_bound = 4;

/// The same of t: twice as much where products of dot and cross products round by themselves, as
/// there are no fused operations.
int rho_bound_of_t(const StressRow& row)
{
    return row.isa == "sse42" ? 2 * rho_bound : rho_bound;
}

class Faults {
public:
    void count(std::uint64_t number, const char* what)
    {
        if (number > 0)
            list.push_back(std::to_string(number) + " " + what);
    }
    void hold(bool holds, const std::string& what)
    {
        if (!holds)
            list.push_back(what);
    }
    /// `what` is empty, or ends with a space.
    void hold_rho(double rho, int bound, const std::string& what)
    {
        hold(rho <= bound, what + "off by more than " + std::to_string(bound) +
                               " times what its inputs' rounding makes");
    }

    std::vector<std::string> list;
};

/// The families with faults, each once, in their order, and the faults of the first row of each.
std::string faulty_families(const std::vector<StressRow>& rows, Precision precision)
{
    std::set<std::string> named;
    std::vector<std::string> texts;
    for (const StressRow& row : rows)
        if (row.precision == precision && !row.faults.empty() && named.insert(row.family).second)
            texts.push_back(row.family + ": " + joined(row.faults));
    return joined(texts, "; ");
}

/// Where t is off by more than 1 ulp of single precision, or a normal by more than 1e-6, because
/// double has no more: the families, and how many of their hits.
std::string limits_of(const std::vector<StressRow>& rows, Precision precision)
{
    std::string list;
    for (const StressRow& row : rows) {
        if (!row.held || row.precision != precision)
            continue;
        const std::uint64_t t = precision == Precision::single ? row.t_at_limit : 0;
        if (t + row.normal_beyond == 0)
            continue;
        list += (list.empty() ? "" : ", ") + row.family + " (" + std::to_string(t) + " t, " +
                std::to_string(row.normal_beyond) + " normals of " + std::to_string(row.hits) + ")";
    }
    return list.empty() ? "" : ", double itself at its limit in " + list;
}

std::string verdict_of_precision(const std::vector<StressRow>& rows, Precision precision)
{
    std::uint64_t rays = 0;
    std::uint64_t wrong = 0;
    std::uint64_t self_hits = 0;
    std::uint64_t lost = 0;
    std::uint64_t bounds = 0;
    std::uint64_t missed = 0;
    std::set<std::string> families;
    std::string mode;
    for (const StressRow& row : rows) {
        if (!row.held || row.precision != precision)
            continue;
        mode = row.mode;
        rays += row.rays;
        wrong += row.wrong;
        self_hits += row.self_hits;
        lost += row.second_lost;
        bounds += row.bounds;
        missed += row.bounds_missed;
        families.insert(row.family);
    }
    if (families.empty())
        return "";
    const std::string name =
        precision == Precision::single ? mode : std::string(language::word_of(precision));
    const std::string bad = faulty_families(rows, precision);
    const std::string counts =
        std::to_string(wrong) + " wrong decisions, " + std::to_string(self_hits) + " self-hits, " +
        std::to_string(lost) + " second hits lost, " +
        (bounds == 0
             ? ""
             : std::to_string(missed) + " of " + std::to_string(bounds) + " bounds missed, ") +
        std::to_string(rays) + " rays";
    return name +
           (!bad.empty() ? " is WRONG in " + bad
            : families.size() == 1
                ? " is right in the family " + *families.begin()
                : " is right in all " + std::to_string(families.size()) + " families") +
           " (" + counts + ")" + limits_of(rows, precision);
}

}  // namespace

std::vector<std::string> faults_of(const StressRow& row)
{
    Faults faults;
    faults.count(row.lost, "lost");
    faults.count(row.false_hits, "false hits");
    faults.count(row.wrong_object, "wrong objects");
    faults.count(row.wrong_root, "wrong roots");
    faults.count(row.occluded, "any-hit answers wrong");
    faults.count(row.order, "all-hits lists with another first object");
    faults.count(row.not_closed, "rays that do not leave once");
    faults.count(row.beyond_own_band, "wrong outside the precision's own band");
    faults.count(row.not_finite, "hits that are no numbers");
    faults.count(row.no_normal, "normals of no length");
    faults.count(row.wrong_side, "normals on the wrong side");
    // Doubles are not refined: their t is as good as the inputs in double.
    const bool refined = row.precision == Precision::single;
    faults.count(refined ? row.t_beyond : 0, "t off by more than an ulp");
    faults.hold(!refined || row.t_beyond_half * 100 <= row.hits,
                "more than 1 in 100 t off by over 0.51 ulp");
    if (!refined)
        faults.hold_rho(row.rho, rho_bound_of_t(row), "t ");
    faults.hold(row.normal.p99 <= normal_bound, "normals off by more than 1e-6");
    faults.count(row.self_hits, "self-hits");
    faults.count(row.second_lost, "second hits lost");
    faults.count(row.second_inexact, "second hits off by more than 1e-6");
    faults.count(row.bounds_missed, "bounds that miss the true t");
    return faults.list;
}

std::vector<std::string> faults_of_measure(const StressRow& row)
{
    const bool power = row.family.starts_with("exponent");
    Faults faults;
    faults.count(row.beyond_own_band, "wrong");
    faults.count(row.not_finite, "that are no numbers");
    faults.hold_rho(row.rho, rho_bound, "");
    faults.hold(!power || row.ulp.max <= 2.0, "powers off by more than 2 ulp");
    return faults.list;
}

std::string stress_verdict(const std::vector<StressRow>& rows)
{
    const std::string single = verdict_of_precision(rows, Precision::single);
    const std::string doubles = verdict_of_precision(rows, Precision::double_);
    if (single.empty() && doubles.empty())
        return "verdict: no rays were traced in an exact mode";
    return "verdict: " + single + (single.empty() || doubles.empty() ? "" : "; ") + doubles;
}

bool without_faults(const std::vector<StressRow>& rows)
{
    return std::all_of(rows.begin(), rows.end(),
                       [](const StressRow& row) { return row.faults.empty(); });
}

}  // namespace packtrace::lab
