#pragma once

#include "simd_packet.hpp"

#include <cmath>
#include <limits>
#include <random>

// Operands for the tests of simd.hpp: every combination of difficult numbers, and random numbers.
namespace packtrace::test {

/// The operands for which an operation keeps its contract.
enum class Domain {
    everything,
    small_numbers,          ///< |a| < 2^21, ties between two integers too
    small_integers,         ///< |i| < 2^21
    normal_positive,        ///< a
    scaled_normal,          ///< a and a * 2^i are normal
    non_negative_integers,  ///< i
};

template <class Real>
[[nodiscard]] std::vector<Real> special_reals()
{
    using Limits = std::numeric_limits<Real>;
    const Real below_one = std::nextafter(Real(1), Real(0));
    const Real above_one = std::nextafter(Real(1), Real(2));
    std::vector<Real> values;
    for (const Real positive :
         {Real(0), Limits::denorm_min(), Limits::min() / 2, Limits::min(), Limits::epsilon(),
          Real(0.5), below_one, Real(1), above_one, Real(1.5), Real(2.5), Real(1e6) + Real(0.5),
          1 / Limits::epsilon(), Limits::max(), Limits::infinity(), Limits::quiet_NaN()}) {
        values.push_back(positive);
        values.push_back(-positive);
    }
    return values;
}

template <class Real>
[[nodiscard]] std::vector<std::int64_t> special_integers()
{
    using Limits = std::numeric_limits<abi::lane_int<Real>>;
    return {0, 1, -1, 2, 7, -8, 0x5a5a5a5a, Limits::max(), Limits::min(), Limits::min() + 1};
}

/// Random numbers over many magnitudes, and random integers of all sizes.
template <class Real>
class RandomLanes {
public:
    [[nodiscard]] Real number(int lowest_exponent, int highest_exponent)
    {
        const Real mantissa = std::uniform_real_distribution<Real>(1, 2)(random_);
        const int exponent =
            std::uniform_int_distribution<int>(lowest_exponent, highest_exponent)(random_);
        const Real sign = (random_() & 1) ? Real(-1) : Real(1);
        return sign * std::ldexp(mantissa, exponent);
    }
    [[nodiscard]] std::int64_t integer()
    {
        const auto all_bits = static_cast<abi::lane_int<Real>>(random_());
        return all_bits >> (random_() % (8 * sizeof(Real)));
    }

private:
    std::mt19937_64 random_{20240229};
};

inline constexpr int random_operands = 20000;

template <class Real>
[[nodiscard]] std::vector<Lane<Real>> all_operands()
{
    std::vector<Lane<Real>> lanes;
    const auto integers = special_integers<Real>();
    std::size_t next = 0;
    for (const Real a : special_reals<Real>())
        for (const Real b : special_reals<Real>())
            for (const Real c : special_reals<Real>()) {
                const std::int64_t i = integers[next % integers.size()];
                const std::int64_t j = integers[next / integers.size() % integers.size()];
                lanes.push_back({a, b, c, i, j});
                ++next;
            }
    RandomLanes<Real> random;
    for (int n = 0; n < random_operands; ++n) {
        Lane<Real> lane{.a = random.number(-30, 30),
                        .b = random.number(-30, 30),
                        .c = random.number(-30, 30),
                        .i = random.integer(),
                        .j = random.integer()};
        lanes.push_back(lane);
    }
    return lanes;
}

template <class Real>
[[nodiscard]] std::vector<Lane<Real>> small_numbers()
{
    std::vector<Lane<Real>> lanes;
    for (int half = -4001; half <= 4001; ++half)
        lanes.push_back({Real(0.5) * static_cast<Real>(half)});
    for (const Real edge : {Real(2097151), Real(2097150.5), Real(0), Real(1e-30)}) {
        lanes.push_back({edge});
        lanes.push_back({-edge});
    }
    RandomLanes<Real> random;
    for (int n = 0; n < random_operands; ++n)
        lanes.push_back({random.number(-40, 19)});
    return lanes;
}

template <class Real>
[[nodiscard]] std::vector<Lane<Real>> small_integers()
{
    std::vector<Lane<Real>> lanes;
    for (std::int64_t i = -2097151; i <= 2097151; i += 61)
        lanes.push_back({0, 0, 0, i});
    for (const std::int64_t i : {-1, 0, 1, 2097151})
        lanes.push_back({0, 0, 0, i});
    return lanes;
}

template <class Real>
[[nodiscard]] std::vector<Lane<Real>> normal_positive()
{
    using Limits = std::numeric_limits<Real>;
    std::vector<Lane<Real>> lanes;
    for (int exponent = Limits::min_exponent - 1; exponent < Limits::max_exponent; ++exponent) {
        const Real power = std::ldexp(Real(1), exponent);
        lanes.push_back({power});
        lanes.push_back({power * (2 - Limits::epsilon())});
    }
    RandomLanes<Real> random;
    for (int n = 0; n < random_operands; ++n)
        lanes.push_back({std::abs(random.number(-100, 100))});
    return lanes;
}

template <class Real>
[[nodiscard]] std::vector<Lane<Real>> scaled_normal()
{
    std::vector<Lane<Real>> lanes;
    RandomLanes<Real> random;
    for (int n = 0; n < random_operands; ++n) {
        Lane<Real> lane{.a = random.number(-63, 63), .i = n % 127 - 63};
        lanes.push_back(lane);
    }
    return lanes;
}

template <class Real>
[[nodiscard]] std::vector<Lane<Real>> operands(Domain domain)
{
    switch (domain) {
        case Domain::small_numbers:
            return small_numbers<Real>();
        case Domain::small_integers:
            return small_integers<Real>();
        case Domain::normal_positive:
            return normal_positive<Real>();
        case Domain::scaled_normal:
            return scaled_normal<Real>();
        default:
            break;
    }
    std::vector<Lane<Real>> lanes = all_operands<Real>();
    if (domain == Domain::non_negative_integers)
        for (Lane<Real>& lane : lanes)
            lane.i &= std::numeric_limits<abi::lane_int<Real>>::max();
    return lanes;
}

}  // namespace packtrace::test
