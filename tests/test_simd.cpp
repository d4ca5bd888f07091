// Every operation of the kernels' simd.hpp on every instruction set of the machine, against plain
// scalar code.
#include "catch.hpp"
#include "simd_scalar.hpp"
#include "simd_whole.hpp"

#include <algorithm>
#include <cstring>
#include <set>
#include <sstream>

namespace packtrace::test {
namespace {

/// Equal bits, so that -0 is not +0; any NaN equals any other.
template <class Real>
bool same(Real a, Real b)
{
    return std::memcmp(&a, &b, sizeof(Real)) == 0 || (a != a && b != b);
}

/// Calls `check(packet)` for packets that hold all of `lanes`; the last one is padded.
template <class Real, class Check>
void for_each_packet(const std::vector<Lane<Real>>& lanes, int width, const Check& check)
{
    for (std::size_t first = 0; first < lanes.size(); first += static_cast<std::size_t>(width)) {
        Packet<Real> packet;
        packet.lanes = width;
        for (int lane = 0; lane < width; ++lane)
            packet.lane[lane] =
                lanes[std::min(first + static_cast<std::size_t>(lane), lanes.size() - 1)];
        check(packet);
    }
}

template <class Real, class Value>
std::string mismatch(const Lane<Real>& in, Value got, Value expected)
{
    std::ostringstream text;
    text.precision(17);
    text << "a = " << in.a << ", b = " << in.b << ", c = " << in.c << ", i = " << in.i
         << ", j = " << in.j << ": got " << got << ", expected " << expected;
    return text.str();
}

/// A description of the first wrong lane; empty if no lane is wrong.
template <class Real>
std::string first_wrong(const abi::KernelTable& table, const RealOp<Real>& op)
{
    const Rounding rounding = is_fused(table) ? Rounding::fused : Rounding::twice;
    std::string wrong;
    for_each_packet(operands<Real>(op.domain), precision<Real>(table).lanes,
                    [&](const Packet<Real>& in) {
                        const PacketResult<Real> got = run_packet(table, op.op, in);
                        for (int lane = 0; lane < in.lanes && wrong.empty(); ++lane) {
                            const Real real = got.reals[static_cast<std::size_t>(lane)];
                            const Real expected = op.expected(in.lane[lane], rounding);
                            if (!same(real, expected))
                                wrong = mismatch(in.lane[lane], real, expected);
                        }
                    });
    return wrong;
}

template <class Real>
std::string first_wrong(const abi::KernelTable& table, const IntOp<Real>& op)
{
    std::string wrong;
    for_each_packet(
        operands<Real>(op.domain), precision<Real>(table).lanes, [&](const Packet<Real>& in) {
            const PacketResult<Real> got = run_packet(table, op.op, in);
            for (int lane = 0; lane < in.lanes && wrong.empty(); ++lane) {
                const std::int64_t integer = got.integers[static_cast<std::size_t>(lane)];
                const std::int64_t expected = op.expected(in.lane[lane]);
                if (integer != expected)
                    wrong = mismatch(in.lane[lane], integer, expected);
            }
        });
    return wrong;
}

/// `expected` may be shorter: the values in further lanes are not specified.
template <class Real>
bool starts_with(PacketResult<Real> got, const PacketResult<Real>& expected)
{
    got.reals.resize(expected.reals.size());
    got.integers.resize(expected.integers.size());
    return got.reals == expected.reals && got.integers == expected.integers;
}

template <class Real>
std::string first_wrong(const abi::KernelTable& table, const PacketOp<Real>& op)
{
    const int lanes = precision<Real>(table).lanes;
    for (std::uint32_t pattern = 0; pattern <= full_pattern(lanes); ++pattern) {
        const Packet<Real> in = packet_of<Real>(pattern, lanes);
        if (!starts_with(run_packet(table, op.op, in), op.expected(in)))
            return "pattern or count " + std::to_string(pattern);
    }
    return {};
}

template <class Op>
void check_everywhere(const std::vector<Op>& ops)
{
    REQUIRE_FALSE(supported_kernels().empty());
    for (const abi::KernelTable* table : supported_kernels())
        for (const Op& op : ops) {
            CAPTURE(table->isa, op.name);
            CHECK(first_wrong(*table, op) == "");
        }
}

/// Operands of madd for which a * b + c is 0 in two roundings, and -2^-2k in one.
template <class Real>
Packet<Real> needs_fusing(int lanes)
{
    const Real tiny = std::numeric_limits<Real>::epsilon();
    Packet<Real> packet;
    packet.lanes = lanes;
    for (Lane<Real>& lane : packet.lane)
        lane = {1 + tiny, 1 - tiny, -1, 0, 0};
    return packet;
}

}  // namespace

TEMPLATE_TEST_CASE("arithmetic gives the scalar bits in every lane", "[simd]", float, double)
{
    check_everywhere(arithmetic_ops<TestType>());
}

TEMPLATE_TEST_CASE("comparisons, masks and selections agree with scalar code", "[simd]", float,
                   double)
{
    check_everywhere(choosing_ops<TestType>());
}

TEMPLATE_TEST_CASE("integer operations and conversions agree with scalar code", "[simd]", float,
                   double)
{
    check_everywhere(integer_ops<TestType>());
}

TEMPLATE_TEST_CASE("operations across lanes hold for every pattern of lanes", "[simd]", float,
                   double)
{
    check_everywhere(packet_ops<TestType>());
}

TEMPLATE_TEST_CASE("madd rounds once on machines with fused multiply-add, else twice", "[simd]",
                   float, double)
{
    const TestType tiny = std::numeric_limits<TestType>::epsilon();
    for (const abi::KernelTable* table : supported_kernels()) {
        CAPTURE(table->isa);
        const Packet<TestType> in = needs_fusing<TestType>(precision<TestType>(*table).lanes);
        const TestType expected = is_fused(*table) ? -tiny * tiny : TestType(0);
        CHECK(run_packet(*table, abi::SimdOp::madd, in).reals[0] == expected);
    }
}

TEMPLATE_TEST_CASE("every operation has exactly one test", "[simd]", float, double)
{
    std::multiset<abi::SimdOp> tested;
    for (const auto& op : arithmetic_ops<TestType>())
        tested.insert(op.op);
    for (const auto& op : choosing_ops<TestType>())
        tested.insert(op.op);
    for (const auto& op : integer_ops<TestType>())
        tested.insert(op.op);
    for (const auto& op : packet_ops<TestType>())
        tested.insert(op.op);
    CHECK(tested.size() == static_cast<std::size_t>(abi::simd_op_count));
    CHECK(std::set<abi::SimdOp>(tested.begin(), tested.end()).size() == tested.size());
}

}  // namespace packtrace::test
