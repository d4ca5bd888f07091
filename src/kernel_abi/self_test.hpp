#pragma once

#include <cstdint>

namespace packtrace::abi {

/// The operations of kernels/simd.hpp, for tests that hold each against plain scalar code.
enum class SimdOp : std::int32_t {
    add,
    sub,
    mul,
    div,
    madd,
    msub,
    nmadd,
    neg,
    abs,
    sqrt,
    floor,
    copysign,
    min,
    max,
    less,
    less_equal,
    equal,
    mask_and,
    mask_or,
    mask_and_not,
    mask_not,
    bits,
    from_bits,
    first_lanes,
    select_real,
    select_int,
    int_equal,
    int_less,
    int_add,
    to_int,
    to_real,
    exponent_of,
    mantissa_of,
    scale_by_power,
    compress,
    any,
    none,
    all
};

inline constexpr int simd_op_count = static_cast<int>(SimdOp::all) + 1;

/// One packet of operands in, one packet of results out. Masks come in as a < b, and go out as
/// 1 and 0; a count or bit pattern goes out in lane 0 of `integers`.
template <class Real>
struct SelfTestJob {
    SimdOp op = SimdOp::add;
    const Real* a = nullptr;
    const Real* b = nullptr;
    const Real* c = nullptr;
    const std::int64_t* i = nullptr;
    const std::int64_t* j = nullptr;
    std::uint32_t mask = 0;            ///< for from_bits and compress
    Real* reals = nullptr;             ///< one packet
    std::int64_t* integers = nullptr;  ///< one packet
};

}  // namespace packtrace::abi
