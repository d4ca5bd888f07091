#include "core/text.hpp"
#include "lab/stress/stress.hpp"
#include "render/option_words.hpp"

#include <algorithm>
#include <set>

namespace packtrace::lab {
namespace {

/// The largest error of 99 of 100 normals.
constexpr double normal_bound = 1e-6;

/// The largest error over the error by rounding the inputs, where errors are not counted in ulps.
constexpr int rho_bound = 4;

/// The same for t. Without fused operations products in dot and cross products are rounded, too,
/// and the bound is twice as large.
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
    void require(bool condition, const std::string& fault)
    {
        if (!condition)
            list.push_back(fault);
    }
    /// `what` is empty, or ends with a space.
    void require_rho(double rho, int bound, const std::string& what)
    {
        require(rho <= bound, what + "off by more than " + std::to_string(bound) +
                                  " times what its inputs' rounding makes");
    }

    std::vector<std::string> list;
};

/// The families with faults, in order, each with the faults of its first row.
std::string faulty_families(const std::vector<StressRow>& rows, Precision precision)
{
    std::set<std::string> named;
    std::vector<std::string> texts;
    for (const StressRow& row : rows)
        if (row.precision == precision && !row.faults.empty() && named.insert(row.family).second)
            texts.push_back(row.family + ": " + joined(row.faults));
    return joined(texts, "; ");
}

/// The families in which t is off by more than 1 ulp of single precision, or a normal by more than
/// 1e-6, because double is no more exact; and how many of their hits.
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

/// Sums over the rows of one precision that count for the verdict.
struct Totals {
    std::uint64_t rays = 0;
    std::uint64_t wrong = 0;
    std::uint64_t self_hits = 0;
    std::uint64_t lost = 0;
    std::uint64_t bounds = 0;
    std::uint64_t missed = 0;
    std::set<std::string> families;
    std::string mode;

    void add(const StressRow& row)
    {
        mode = row.mode;
        rays += row.rays;
        wrong += row.wrong;
        self_hits += row.self_hits;
        lost += row.second_lost;
        bounds += row.bounds;
        missed += row.bounds_missed;
        families.insert(row.family);
    }

    [[nodiscard]] std::string text() const
    {
        const std::string of_bounds =
            std::to_string(missed) + " of " + std::to_string(bounds) + " bounds missed, ";
        return std::to_string(wrong) + " wrong decisions, " + std::to_string(self_hits) +
               " self-hits, " + std::to_string(lost) + " second hits lost, " +
               (bounds == 0 ? "" : of_bounds) + std::to_string(rays) + " rays";
    }
};

std::string verdict_of_precision(const std::vector<StressRow>& rows, Precision precision)
{
    Totals totals;
    for (const StressRow& row : rows)
        if (row.held && row.precision == precision)
            totals.add(row);
    if (totals.families.empty())
        return "";
    const std::string name =
        precision == Precision::single ? totals.mode : std::string(language::word_of(precision));
    const std::string bad = faulty_families(rows, precision);
    const std::size_t count = totals.families.size();
    return name +
           (!bad.empty() ? " is WRONG in " + bad
            : count == 1 ? " is right in the family " + *totals.families.begin()
                         : " is right in all " + std::to_string(count) + " families") +
           " (" + totals.text() + ")" + limits_of(rows, precision);
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
    // Hits in double are not refined: their t is as exact as rounding the inputs allows.
    const bool refined = row.precision == Precision::single;
    faults.count(refined ? row.t_beyond : 0, "t off by more than an ulp");
    faults.require(!refined || row.t_beyond_half * 100 <= row.hits,
                   "more than 1 in 100 t off by over 0.51 ulp");
    if (!refined)
        faults.require_rho(row.rho, rho_bound_of_t(row), "t ");
    faults.require(row.normal.p99 <= normal_bound, "normals off by more than 1e-6");
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
    faults.require_rho(row.rho, rho_bound, "");
    faults.require(!power || row.ulp.max <= 2.0, "powers off by more than 2 ulp");
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
