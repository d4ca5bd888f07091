#include "core/seconds_since.hpp"
#include "dispatch/kernels.hpp"
#include "lab/stress/stress_measure.hpp"
#include "lab/stress/stress_random.hpp"
#include "render/precision.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <chrono>
#include <cmath>
#include <memory>

// The highlights' x^n.
namespace packtrace::lab {
namespace {

/// Smaller powers are the faint edge of a highlight and are not tested, as in
/// results/highlight_power.json.
constexpr double smallest_counted = 1e-4;

/// Numbers of 113 bits with a power function.
using Exact = boost::multiprecision::cpp_bin_float_quad;

template <class Real>
struct Powers {
    std::vector<Real> x, n;
    std::vector<Exact> exact;
};

template <class Real>
Powers<Real> make_powers(const StressOptions& options, double least, double most)
{
    StressRandom random(options.seed);
    Powers<Real> powers;
    for (int i = 0; i < options.rays; ++i) {
        const double exponent = random.power(least, most);
        const auto n = static_cast<Real>(random.below(2) == 0 ? std::round(exponent) : exponent);
        const double y = random.power(smallest_counted, 1.0);
        const auto x = static_cast<Real>(std::pow(y, 1.0 / static_cast<double>(n)));
        powers.x.push_back(x);
        powers.n.push_back(n);
        powers.exact.push_back(pow(Exact(x), Exact(n)));
    }
    return powers;
}

template <class Real>
MeasureRun ask(const Powers<Real>& powers, const StressSubject& subject, const Alone& alone)
{
    const auto& table = precision<Real>(kernels_of(subject.isa));
    std::vector<Real> y(powers.x.size());
    MeasureRun run;
    run_alone(alone, [&] {
        const auto start = std::chrono::steady_clock::now();
        table.highlight_power(powers.x.data(), powers.n.data(), y.data(),
                              static_cast<int>(y.size()));
        run.seconds = seconds_since(start);
    });

    run.errors.rays = run.errors.hits = y.size();
    const double unit = std::numeric_limits<Real>::epsilon();
    for (std::size_t i = 0; i < y.size(); ++i) {
        const Exact error = abs(Exact(y[i]) - powers.exact[i]);
        const double last_place =
            std::ldexp(unit, std::ilogb(static_cast<double>(powers.exact[i])));
        run.errors.ulp.push_back(static_cast<float>(static_cast<double>(error) / last_place));
        run.errors.not_finite += !std::isfinite(y[i]);
        run.answers.push_back(static_cast<double>(y[i]));
    }
    return run;
}

template <class Real>
StressMeasure::Ask prepared(const StressOptions& options, double least, double most)
{
    const auto powers = std::make_shared<Powers<Real>>(make_powers<Real>(options, least, most));
    return [powers, alone = options.alone](const StressSubject& subject) {
        return ask(*powers, subject, alone);
    };
}

StressMeasure measure(const char* name, const char* what, double least, double most)
{
    return {name, what, [=](Precision precision, const StressOptions& options) {
                return with_packet_real(
                    precision, [&]<class Real>() { return prepared<Real>(options, least, most); });
            }};
}

}  // namespace

std::vector<StressMeasure> power_measures()
{
    return {measure("exponents", "highlights' x^n, n from 1 to 10000", 1.0, 1e4),
            measure("exponent-1", "highlights' x^1", 1.0, 1.0),
            measure("exponent-10000", "highlights' x^10000", 1e4, 1e4)};
}

}  // namespace packtrace::lab
