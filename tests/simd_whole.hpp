#pragma once

#include "simd_packet.hpp"

// The expected results of the horizontal operations of simd.hpp, in plain scalar code.
namespace packtrace::test {

/// A horizontal operation gets a packet whose mask a < b is also `mask`. Its result must equal the
/// values of `expected` in the first lanes.
template <class Real>
struct PacketOp {
    abi::SimdOp op;
    const char* name;
    PacketResult<Real> (*expected)(const Packet<Real>& in);
};

/// Lanes with different values, and a < b exactly in the lanes of `pattern`.
template <class Real>
[[nodiscard]] Packet<Real> packet_of(std::uint32_t pattern, int lanes)
{
    Packet<Real> packet;
    packet.lanes = lanes;
    packet.mask = pattern;
    for (int lane = 0; lane < lanes; ++lane) {
        const Real a = static_cast<Real>(lane) + Real(0.25);
        const Real b = ((pattern >> lane) & 1) ? a + 1 : a;
        packet.lane[lane] = {a, b, 0, 1000 - 3 * lane, 0};
    }
    return packet;
}

[[nodiscard]] inline std::uint32_t full_pattern(int lanes)
{
    return (1u << lanes) - 1u;
}

template <class Real>
[[nodiscard]] PacketResult<Real> chosen_reals(const Packet<Real>& in)
{
    PacketResult<Real> result;
    for (int lane = 0; lane < in.lanes; ++lane)
        if ((in.mask >> lane) & 1)
            result.reals.push_back(in.lane[lane].a);
    return result;
}

template <class Real>
[[nodiscard]] PacketResult<Real> chosen_integers(const Packet<Real>& in)
{
    PacketResult<Real> result;
    for (int lane = 0; lane < in.lanes; ++lane)
        if ((in.mask >> lane) & 1)
            result.integers.push_back(in.lane[lane].i);
    return result;
}

template <class Real>
[[nodiscard]] PacketResult<Real> pattern_as_numbers(const Packet<Real>& in)
{
    PacketResult<Real> result;
    for (int lane = 0; lane < in.lanes; ++lane)
        result.reals.push_back(static_cast<Real>((in.mask >> lane) & 1));
    return result;
}

/// `mask` is a count here.
template <class Real>
[[nodiscard]] PacketResult<Real> first_as_numbers(const Packet<Real>& in)
{
    PacketResult<Real> result;
    for (int lane = 0; lane < in.lanes; ++lane)
        result.reals.push_back(Real(static_cast<std::uint32_t>(lane) < in.mask));
    return result;
}

template <class Real>
[[nodiscard]] PacketResult<Real> one_integer(std::int64_t value)
{
    PacketResult<Real> result;
    result.integers.push_back(value);
    return result;
}

template <class Real>
[[nodiscard]] std::vector<PacketOp<Real>> packet_ops()
{
    using enum abi::SimdOp;
    using In = const Packet<Real>&;
    return {
        {bits, "bits", [](In in) { return one_integer<Real>(in.mask); }},
        {any, "any", [](In in) { return one_integer<Real>(in.mask != 0); }},
        {none, "none", [](In in) { return one_integer<Real>(in.mask == 0); }},
        {all, "all", [](In in) { return one_integer<Real>(in.mask == full_pattern(in.lanes)); }},
        {from_bits, "from_bits", pattern_as_numbers<Real>},
        {first_lanes, "first_lanes", first_as_numbers<Real>},
        {compress, "compress", chosen_reals<Real>},
        {compress_store_real, "compress_store of reals", chosen_reals<Real>},
        {compress_store_int, "compress_store of ints", chosen_integers<Real>},
        {first_lane, "first_lane",
         [](In in) {
             PacketResult<Real> result;
             result.reals.assign(static_cast<std::size_t>(in.lanes), in.lane[0].a);
             return result;
         }},
    };
}

}  // namespace packtrace::test
