#include "cli/intersect/ray_number.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace packtrace::cli {
namespace {

template <class Real>
RayNumber<Real> parse(std::string_view text)
{
    RayNumber<Real> number;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number.value);
    number.error = stop == end ? error : std::errc::invalid_argument;
    return number;
}

// from_chars does not tell too small from too large, but a wider type does.
template <class Real>
RayNumber<Real> parse_extreme(std::string_view text)
{
    const RayNumber<long double> wide = parse<long double>(text);
    const bool large = std::abs(wide.value) > std::numeric_limits<Real>::max();
    if (wide.error != std::errc{} || large)
        return {Real{}, std::errc::result_out_of_range};
    return {static_cast<Real>(wide.value), std::errc{}};
}

}  // namespace

template <class Real>
RayNumber<Real> to_ray_number(std::string_view field)
{
    // The scene language has the plus sign too, from_chars does not.
    if (field.starts_with('+') && !field.starts_with("+-"))
        field.remove_prefix(1);
    const RayNumber<Real> number = parse<Real>(field);
    return number.error == std::errc::result_out_of_range ? parse_extreme<Real>(field) : number;
}

template RayNumber<float> to_ray_number(std::string_view);
template RayNumber<double> to_ray_number(std::string_view);

}  // namespace packtrace::cli
