// Verdicts on synthetic samples.
#include "catch.hpp"
#include "lab/bench/slowdown.hpp"

#include <algorithm>
#include <cstddef>
#include <random>

namespace packtrace::test {
namespace {

/// Times of a busy machine around `center`: most within a few per cent, every fifth far longer.
/// `spell` is the factor of a busy spell that covers all samples.
std::vector<double> busy_samples(std::mt19937& random, std::size_t count, double center,
                                 double spell = 1.0)
{
    std::vector<double> samples;
    for (std::size_t i = 0; i < count; ++i) {
        const double noise = 1.0 + 0.05 * (static_cast<double>(random()) / 4294967296.0);
        samples.push_back(center * spell * noise * (random() % 5 == 0 ? 1.7 : 1.0));
    }
    return samples;
}

/// Nine equal samples.
std::vector<double> nine(double value)
{
    return std::vector<double>(9, value);
}

/// The number of trials whose verdict is `verdict`.
template <class Trial>
int count_of(Verdict verdict, int trials, const Trial& trial)
{
    int count = 0;
    for (int i = 0; i < trials; ++i)
        count += verdict_of(trial(), 0.1) == verdict;
    return count;
}

}  // namespace

TEST_CASE("the median is between the order statistics that the binomial distribution gives",
          "[slowdown]")
{
    const std::vector<double> values{5, 3, 8, 1, 9, 2, 7, 4, 6, 10, 11};
    // The probability of fewer than 2 heads in 11 throws is 12 in 2048, more than half of a
    // hundredth; of no heads: 1 in 2048.
    CHECK(median_interval(values)->low == 1.0);
    CHECK(median_interval(values)->high == 11.0);
    std::vector<double> many;
    for (int i = 1; i <= 27; ++i)
        many.push_back(i);
    CHECK(median_interval(many)->low == 7.0);
    CHECK(median_interval(many)->high == 21.0);
    CHECK(median_interval(std::vector<double>(8, 1.0)));
    CHECK_FALSE(median_interval(std::vector<double>(7, 1.0)));
    CHECK_FALSE(median_interval({}));
    // Even if 0.5 to that power is nearly too small for a number.
    CHECK(median_interval(std::vector<double>(1000, 3.0))->low == 3.0);
}

TEST_CASE("a shift is between differences of all pairs", "[slowdown]")
{
    std::vector<double> a, b;
    for (int i = 0; i < 9; ++i) {
        b.push_back(i);
        a.push_back(i + 100.0);
    }
    CHECK(shift(a, b) == 100.0);
    const std::optional<Interval> interval = shift_interval(a, b);
    REQUIRE(interval);
    // The 11th of 81: one difference of 92, two of 93, three of 94, four of 95.
    CHECK(interval->low == 96.0);
    CHECK(interval->high == 104.0);
    CHECK(shift_interval(std::vector<double>(6, 1.0), std::vector<double>(6, 1.0)));
    CHECK_FALSE(shift_interval(std::vector<double>(5, 1.0), std::vector<double>(5, 1.0)));
    CHECK_FALSE(shift_interval({}, b));
}

TEST_CASE("intervals contain the truth as often as promised", "[slowdown]")
{
    std::mt19937 random(7);
    int paired = 0;
    int apart = 0;
    for (int i = 0; i < 1000; ++i) {
        const Slowdown in_pairs =
            paired_slowdown(busy_samples(random, 9, 1.1), busy_samples(random, 9, 1.0));
        const Slowdown unpaired =
            unpaired_slowdown(busy_samples(random, 9, 1.1), busy_samples(random, 9, 1.0));
        paired += in_pairs.interval->low <= 0.1 && 0.1 <= in_pairs.interval->high;
        apart += unpaired.interval->low <= 0.1 && 0.1 <= unpaired.interval->high;
    }
    CHECK(paired >= 985);
    CHECK(apart >= 985);
}

TEST_CASE("equal programs are never called slower, however busy the machine", "[slowdown]")
{
    std::mt19937 random(1);
    const int slower_in_pairs = count_of(Verdict::slower, 1000, [&] {
        return paired_slowdown(busy_samples(random, 9, 1.0), busy_samples(random, 9, 1.0));
    });
    const int slower_apart = count_of(Verdict::slower, 1000, [&] {
        return unpaired_slowdown(busy_samples(random, 9, 1.0), busy_samples(random, 9, 1.0));
    });
    CHECK(slower_in_pairs == 0);
    CHECK(slower_apart == 0);
}

TEST_CASE("a busy spell during both programs of a pair does not change the verdict", "[slowdown]")
{
    std::vector<double> now, before;
    for (const double spell : {1.0, 1.0, 3.0, 2.0, 1.0, 7.0, 1.5, 1.0, 4.0}) {
        before.push_back(spell);
        now.push_back(1.05 * spell);
    }
    CHECK(paired_slowdown(now, before).estimate == Approx(0.05));
    CHECK(verdict_of(paired_slowdown(now, before), 0.1) == Verdict::not_slower);
    CHECK(verdict_of(paired_slowdown(now, before), 0.04) == Verdict::slower);
    // The unpaired comparison cannot decide.
    CHECK(verdict_of(unpaired_slowdown(now, before), 0.04) == Verdict::cannot_tell);
}

TEST_CASE("a program that takes twice as long is detected, even on a busy machine", "[slowdown]")
{
    std::mt19937 random(3);
    CHECK(count_of(Verdict::slower, 100, [&] {
              return unpaired_slowdown(busy_samples(random, 9, 2.0), busy_samples(random, 9, 1.0));
          }) == 100);
    CHECK(count_of(Verdict::slower, 100, [&] {
              return paired_slowdown(busy_samples(random, 27, 2.0), busy_samples(random, 27, 1.0));
          }) == 100);
}

TEST_CASE("the verdict depends on the whole interval, not on its middle", "[slowdown]")
{
    const auto of = [](double low, double high) {
        return verdict_of({0.2, Interval{low, high}}, 0.1);
    };
    CHECK(of(0.11, 0.3) == Verdict::slower);
    CHECK(of(0.1, 0.3) == Verdict::cannot_tell);
    CHECK(of(-0.1, 0.3) == Verdict::cannot_tell);
    CHECK(of(-0.1, 0.1) == Verdict::not_slower);
    CHECK(of(-0.5, -0.2) == Verdict::not_slower);
    CHECK(verdict_of({0.2, std::nullopt}, 0.1) == Verdict::cannot_tell);
}

TEST_CASE("equal samples have intervals without width", "[slowdown]")
{
    const Slowdown tenth = paired_slowdown(nine(1.1), nine(1.0));
    CHECK(tenth.estimate == Approx(0.1));
    CHECK(tenth.interval->low == Approx(0.1));
    CHECK(tenth.interval->high == Approx(0.1));
    CHECK(unpaired_slowdown(nine(1.1), nine(1.0)).interval->high == Approx(0.1));
    CHECK_FALSE(paired_slowdown({1.0, 1.0}, {1.0, 1.0}).interval);
}

}  // namespace packtrace::test
