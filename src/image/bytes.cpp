#include "image/bytes.hpp"

#include <cmath>

namespace packtrace {
namespace {

// Comparisons with NaN are false, so the first one makes it 0.
template <class Real>
std::uint8_t to_byte(Real value)
{
    const Real scaled = value * Real(255);
    const Real positive = scaled > Real(0) ? scaled : Real(0);
    const Real clamped = positive < Real(255) ? positive : Real(255);
    return static_cast<std::uint8_t>(static_cast<int>(clamped + Real(0.5)));
}

}  // namespace

template <class Real>
void quantise(std::span<const Real> values, double gamma, std::uint8_t* to)
{
    if (gamma == 1.0) {
        for (std::size_t i = 0; i < values.size(); ++i)
            to[i] = to_byte(values[i]);
        return;
    }
    const auto exponent = static_cast<Real>(1.0 / gamma);
    for (std::size_t i = 0; i < values.size(); ++i)
        to[i] = to_byte(values[i] > Real(0) ? std::pow(values[i], exponent) : Real(0));
}

template void quantise(std::span<const float>, double, std::uint8_t*);
template void quantise(std::span<const double>, double, std::uint8_t*);
template void quantise(std::span<const long double>, double, std::uint8_t*);

}  // namespace packtrace
