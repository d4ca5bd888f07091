#pragma once

#include "dispatch/kernels.hpp"
#include <packtrace/isa.hpp>

#include <cstdint>
#include <string>
#include <vector>

// Runs single operations of the kernels' simd.hpp on packets, for every instruction set of the
// machine.
namespace packtrace::test {

inline constexpr int max_lanes = 16;

/// The operands of one lane.
template <class Real>
struct Lane {
    Real a = 0;
    Real b = 0;
    Real c = 0;
    std::int64_t i = 0;
    std::int64_t j = 0;
};

template <class Real>
struct Packet {
    int lanes = 0;
    Lane<Real> lane[max_lanes];
    std::uint32_t mask = 0;
};

/// The actual or expected result of an operation in a packet's first lanes.
template <class Real>
struct PacketResult {
    std::vector<Real> reals;
    std::vector<std::int64_t> integers;
};

/// The kernels that this machine can run.
[[nodiscard]] inline std::vector<const abi::KernelTable*> supported_kernels()
{
    std::vector<const abi::KernelTable*> tables;
    for (const abi::KernelTable* table : all_kernels())
        if (cpu_runs(table->isa))
            tables.push_back(table);
    return tables;
}

/// sse42 is the only instruction set here without fused multiply-add.
[[nodiscard]] inline bool is_fused(const abi::KernelTable& table)
{
    return std::string(table.isa) != "sse42";
}

template <class Real>
[[nodiscard]] PacketResult<Real> run_packet(const abi::KernelTable& table, abi::SimdOp op,
                                            const Packet<Real>& in)
{
    Real a[max_lanes], b[max_lanes], c[max_lanes];
    std::int64_t i[max_lanes], j[max_lanes];
    for (int lane = 0; lane < max_lanes; ++lane) {
        a[lane] = in.lane[lane].a;
        b[lane] = in.lane[lane].b;
        c[lane] = in.lane[lane].c;
        i[lane] = in.lane[lane].i;
        j[lane] = in.lane[lane].j;
    }
    PacketResult<Real> result;
    result.reals.resize(max_lanes);
    result.integers.resize(max_lanes);
    precision<Real>(table).self_test(
        {op, a, b, c, i, j, in.mask, result.reals.data(), result.integers.data()});
    return result;
}

}  // namespace packtrace::test
