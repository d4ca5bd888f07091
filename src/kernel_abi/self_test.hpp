#pragma once

#include <cstdint>

namespace packtrace::abi {

/// The operations of kernels/simd/simd.hpp. Tests compare each with plain scalar code.
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
    greater,
    greater_equal,
    equal,
    mask_and,
    mask_or,
    either,
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
    int_sub,
    int_and,
    int_or,
    shift_left,
    shift_right,
    to_int,
    to_real,
    exponent_of,
    mantissa_of,
    scale_by_power,
    halves,
    compress,
    compress_store_real,
    compress_store_int,
    first_lane,
    any,
    none,
    all
};

inline constexpr int simd_op_count = static_cast<int>(SimdOp::all) + 1;

/// One packet of operands and one packet of results. An operand mask is a < b, a second one b < c.
/// Masks are returned in `reals` as 1 and 0; a truth value or bit pattern is returned in every
/// element of `integers`. Shifts are by the number of mantissa bits. For floats, `halves` is a b -
/// c in double, rounded once.
template <class Real>
struct SelfTestJob {
    SimdOp op = SimdOp::add;
    const Real* a = nullptr;
    const Real* b = nullptr;
    const Real* c = nullptr;
    const std::int64_t* i = nullptr;
    const std::int64_t* j = nullptr;
    std::uint32_t mask = 0;            ///< lanes of from_bits and compress, count of first_lanes
    Real* reals = nullptr;             ///< one packet
    std::int64_t* integers = nullptr;  ///< one packet
};

}  // namespace packtrace::abi
