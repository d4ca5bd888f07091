#pragma once

#include "simd_operands.hpp"

#include <bit>
#include <cmath>

// The expected result of each lane-wise operation of simd.hpp, in plain scalar code.
namespace packtrace::test {

enum class Rounding { twice, fused };

template <class Real>
struct RealOp {
    abi::SimdOp op;
    const char* name;
    Domain domain;
    Real (*expected)(const Lane<Real>& in, Rounding rounding);
};

template <class Real>
struct IntOp {
    abi::SimdOp op;
    const char* name;
    Domain domain;
    std::int64_t (*expected)(const Lane<Real>& in);
};

/// a b + c, with one rounding or with two.
template <class Real>
[[nodiscard]] Real scalar_madd(Real a, Real b, Real c, Rounding rounding)
{
    return rounding == Rounding::fused ? std::fma(a, b, c) : a * b + c;
}

template <class Real>
[[nodiscard]] std::vector<RealOp<Real>> arithmetic_ops()
{
    using enum abi::SimdOp;
    using In = const Lane<Real>&;
    const Domain everything = Domain::everything;
    return {
        {add, "add", everything, [](In in, Rounding) { return in.a + in.b; }},
        {sub, "sub", everything, [](In in, Rounding) { return in.a - in.b; }},
        {mul, "mul", everything, [](In in, Rounding) { return in.a * in.b; }},
        {div, "div", everything, [](In in, Rounding) { return in.a / in.b; }},
        {madd, "madd", everything,
         [](In in, Rounding rounding) { return scalar_madd(in.a, in.b, in.c, rounding); }},
        {msub, "msub", everything,
         [](In in, Rounding rounding) { return scalar_madd(in.a, in.b, -in.c, rounding); }},
        {nmadd, "nmadd", everything,
         [](In in, Rounding rounding) { return scalar_madd(-in.a, in.b, in.c, rounding); }},
        {neg, "negated", everything, [](In in, Rounding) { return -in.a; }},
        {halves, "halves in double", everything,
         [](In in, Rounding) {
             return static_cast<Real>(static_cast<double>(in.a) * static_cast<double>(in.b) -
                                      static_cast<double>(in.c));
         }},
        {abs, "abs", everything, [](In in, Rounding) { return std::abs(in.a); }},
        {sqrt, "sqrt", everything, [](In in, Rounding) { return std::sqrt(in.a); }},
        {floor, "floor", everything, [](In in, Rounding) { return std::floor(in.a); }},
        {copysign, "with_sign_of", everything,
         [](In in, Rounding) { return std::copysign(in.a, in.b); }},
        // If either operand is NaN, or the operands are -0 and +0, the result is the first operand.
        {min, "min", everything, [](In in, Rounding) { return in.b < in.a ? in.b : in.a; }},
        {max, "max", everything, [](In in, Rounding) { return in.b > in.a ? in.b : in.a; }},
        {to_real, "to_real", Domain::small_integers,
         [](In in, Rounding) { return static_cast<Real>(in.i); }},
        {mantissa_of, "mantissa_of", Domain::normal_positive,
         [](In in, Rounding) { return std::scalbn(in.a, -std::ilogb(in.a)); }},
        {scale_by_power, "scale_by_power", Domain::scaled_normal,
         [](In in, Rounding) { return std::scalbn(in.a, static_cast<int>(in.i)); }},
    };
}

/// Operations that compare or choose. A mask is a number here, 1 for true.
template <class Real>
[[nodiscard]] std::vector<RealOp<Real>> choosing_ops()
{
    using enum abi::SimdOp;
    using In = const Lane<Real>&;
    const Domain everything = Domain::everything;
    return {
        {less, "less", everything, [](In in, Rounding) { return Real(in.a < in.b); }},
        {less_equal, "less_equal", everything, [](In in, Rounding) { return Real(in.a <= in.b); }},
        {greater, "greater", everything, [](In in, Rounding) { return Real(in.a > in.b); }},
        {greater_equal, "greater_equal", everything,
         [](In in, Rounding) { return Real(in.a >= in.b); }},
        {equal, "equal", everything, [](In in, Rounding) { return Real(in.a == in.b); }},
        {mask_and, "mask_and", everything,
         [](In in, Rounding) { return Real(in.a < in.b && in.b < in.c); }},
        {mask_or, "mask_or", everything,
         [](In in, Rounding) { return Real(in.a < in.b || in.b < in.c); }},
        {either, "either", everything,
         [](In in, Rounding) { return Real(in.a < in.b || in.b < in.c); }},
        {mask_and_not, "mask_and_not", everything,
         [](In in, Rounding) { return Real(in.a < in.b && !(in.b < in.c)); }},
        {mask_not, "mask_not", everything, [](In in, Rounding) { return Real(!(in.a < in.b)); }},
        {select_real, "select of reals", everything,
         [](In in, Rounding) { return in.a < in.b ? in.b : in.c; }},
        {int_equal, "int_equal", everything, [](In in, Rounding) { return Real(in.i == in.j); }},
        {int_less, "int_less", everything, [](In in, Rounding) { return Real(in.i < in.j); }},
    };
}

/// The integer that `bits` wrap around to in a lane.
template <class Real>
[[nodiscard]] std::int64_t wrapped(std::uint64_t bits)
{
    return static_cast<abi::lane_int<Real>>(bits);
}

template <class Real>
[[nodiscard]] std::vector<IntOp<Real>> integer_ops()
{
    using enum abi::SimdOp;
    using In = const Lane<Real>&;
    using Bits = std::uint64_t;
    constexpr int shift = std::numeric_limits<Real>::digits - 1;
    const Domain everything = Domain::everything;
    return {
        {select_int, "select of ints", everything, [](In in) { return in.a < in.b ? in.i : in.j; }},
        {int_add, "int_add", everything,
         [](In in) { return wrapped<Real>(static_cast<Bits>(in.i) + static_cast<Bits>(in.j)); }},
        {int_sub, "int_sub", everything,
         [](In in) { return wrapped<Real>(static_cast<Bits>(in.i) - static_cast<Bits>(in.j)); }},
        {int_and, "int_and", everything, [](In in) { return in.i & in.j; }},
        {int_or, "int_or", everything, [](In in) { return in.i | in.j; }},
        {shift_left, "shift_left", everything,
         [](In in) { return wrapped<Real>(static_cast<Bits>(in.i) << shift); }},
        {shift_right, "shift_right", Domain::non_negative_integers,
         [](In in) { return in.i >> shift; }},
        {to_int, "to_int", Domain::small_numbers,
         [](In in) { return static_cast<std::int64_t>(std::nearbyint(in.a)); }},
        {exponent_of, "exponent_of", Domain::normal_positive,
         [](In in) { return static_cast<std::int64_t>(std::ilogb(in.a)); }},
    };
}

}  // namespace packtrace::test
