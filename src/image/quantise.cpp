#include "image/quantise.hpp"

#include <cmath>

namespace packtrace {
namespace {

// Both comparisons are false for NaN, the first of which makes it 0.
std::uint8_t to_byte(float value)
{
    const float scaled = value * 255.0f;
    const float positive = scaled > 0.0f ? scaled : 0.0f;
    const float clamped = positive < 255.0f ? positive : 255.0f;
    return static_cast<std::uint8_t>(static_cast<int>(clamped + 0.5f));
}

}  // namespace

void quantise(std::span<const float> values, double gamma, std::uint8_t* to)
{
    if (gamma == 1.0) {
        for (std::size_t i = 0; i < values.size(); ++i)
            to[i] = to_byte(values[i]);
        return;
    }
    const auto exponent = static_cast<float>(1.0 / gamma);
    for (std::size_t i = 0; i < values.size(); ++i)
        to[i] = to_byte(values[i] > 0.0f ? std::pow(values[i], exponent) : 0.0f);
}

}  // namespace packtrace
