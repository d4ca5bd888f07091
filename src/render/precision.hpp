#pragma once

#include <packtrace/render.hpp>

#include <array>
#include <type_traits>

// Maps a precision chosen at run time to the type that templates need.
namespace packtrace {

/// The precisions of packets.
inline constexpr std::array packet_precisions{Precision::single, Precision::double_};

/// The precision of float, double or long double.
template <class Real>
inline constexpr Precision precision_of = std::is_same_v<Real, float>    ? Precision::single
                                          : std::is_same_v<Real, double> ? Precision::double_
                                                                         : Precision::extended;

/// Returns `call.template operator()<Real>()` for the type of one of packet_precisions.
template <class Call>
auto with_packet_real(Precision precision, const Call& call)
{
    return precision == Precision::single ? call.template operator()<float>()
                                          : call.template operator()<double>();
}

/// Returns `call.template operator()<Real>()` for the type of any precision.
template <class Call>
auto with_real(Precision precision, const Call& call)
{
    return precision == Precision::extended ? call.template operator()<long double>()
                                            : with_packet_real(precision, call);
}

}  // namespace packtrace
