#pragma once

#include "kernel_abi/self_test.hpp"
#include "kernels/simd/float_bits.hpp"
#include "kernels/simd/vec3.hpp"

// Runs single operations for the tests that hold each against plain scalar code.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct SelfTestOperands {
    vreal<Real> a, b, c;
    vint<Real> i, j;
    vmask<Real> m;
    vreal<Real> one = vreal<Real>(Real(1));
    vreal<Real> zero = vreal<Real>(Real(0));

    explicit SelfTestOperands(const abi::SelfTestJob<Real>& job)
        : a(load(job.a)),
          b(load(job.b)),
          c(load(job.c)),
          i(integers(job.i)),
          j(integers(job.j)),
          m(a < b)
    {
    }

    static vint<Real> integers(const std::int64_t* from)
    {
        alignas(64) lane_int<Real> by_lane[lanes<Real>];
        for (int lane = 0; lane < lanes<Real>; ++lane)
            by_lane[lane] = static_cast<lane_int<Real>>(from[lane]);
        return load(by_lane);
    }

    vreal<Real> as_numbers(vmask<Real> mask) const
    {
        return select(mask, one, zero);
    }
};

/// What compress_store leaves in memory.
template <class Packet>
inline Packet compressed(const Packet& x, std::uint32_t pattern)
{
    alignas(64) typename Packet::value_type by_lane[Packet::size];
    compress_store(by_lane, pattern, x);
    return load(by_lane);
}

/// a b - c by way of the two halves in double, where there are any.
inline vreal<float> by_halves(const SelfTestOperands<float>& in)
{
    return narrow(widen_low(in.a) * widen_low(in.b) - widen_low(in.c),
                  widen_high(in.a) * widen_high(in.b) - widen_high(in.c));
}
inline vreal<double> by_halves(const SelfTestOperands<double>& in)
{
    return in.a * in.b - in.c;
}

/// Operations whose result is a packet of reals or a mask.
template <class Real>
inline vreal<Real> real_result(const abi::SelfTestJob<Real>& job, const SelfTestOperands<Real>& in)
{
    using abi::SimdOp;
    const auto odd = in.b < in.c;
    switch (job.op) {
        case SimdOp::add:
            return in.a + in.b;
        case SimdOp::sub:
            return in.a - in.b;
        case SimdOp::mul:
            return in.a * in.b;
        case SimdOp::div:
            return in.a / in.b;
        case SimdOp::madd:
            return madd(in.a, in.b, in.c);
        case SimdOp::msub:
            return msub(in.a, in.b, in.c);
        case SimdOp::nmadd:
            return nmadd(in.a, in.b, in.c);
        case SimdOp::neg:
            return negated(in.a);
        case SimdOp::abs:
            return abs(in.a);
        case SimdOp::sqrt:
            return sqrt(in.a);
        case SimdOp::floor:
            return floor(in.a);
        case SimdOp::copysign:
            return with_sign_of(abs(in.a), in.b);
        case SimdOp::min:
            return min(in.a, in.b);
        case SimdOp::max:
            return max(in.a, in.b);
        case SimdOp::less:
            return in.as_numbers(in.a < in.b);
        case SimdOp::less_equal:
            return in.as_numbers(in.a <= in.b);
        case SimdOp::greater:
            return in.as_numbers(in.a > in.b);
        case SimdOp::greater_equal:
            return in.as_numbers(in.a >= in.b);
        case SimdOp::equal:
            return in.as_numbers(in.a == in.b);
        case SimdOp::mask_and:
            return in.as_numbers(in.m & odd);
        case SimdOp::mask_or:
            return in.as_numbers(in.m | odd);
        case SimdOp::either:
            return in.as_numbers(either(in.m, odd));
        case SimdOp::mask_and_not:
            return in.as_numbers(in.m & !odd);
        case SimdOp::mask_not:
            return in.as_numbers(!in.m);
        case SimdOp::from_bits:
            return in.as_numbers(from_bits<Real>(job.mask));
        case SimdOp::first_lanes:
            return in.as_numbers(from_bits<Real>(first_lanes<Real>(static_cast<int>(job.mask))));
        case SimdOp::select_real:
            return select(in.m, in.b, in.c);
        case SimdOp::int_equal:
            return in.as_numbers(int_equal(in.i, in.j));
        case SimdOp::int_less:
            return in.as_numbers(int_less(in.i, in.j));
        case SimdOp::to_real:
            return to_real<Real>(in.i);
        case SimdOp::mantissa_of:
            return mantissa_of(in.a);
        case SimdOp::scale_by_power:
            return scale_by_power<Real>(in.a, in.i);
        case SimdOp::halves:
            return by_halves(in);
        case SimdOp::compress:
            return compress(job.mask, in.a);
        case SimdOp::compress_store_real:
            return compressed(in.a, job.mask);
        case SimdOp::first_lane:
            return vreal<Real>(first_lane(in.a));
        default:
            return in.zero;
    }
}

/// Operations whose result is a packet of integers.
template <class Real>
inline vint<Real> int_result(const abi::SelfTestJob<Real>& job, const SelfTestOperands<Real>& in)
{
    using abi::SimdOp;
    switch (job.op) {
        case SimdOp::select_int:
            return select(in.m, in.i, in.j);
        case SimdOp::int_add:
            return in.i + in.j;
        case SimdOp::int_sub:
            return in.i - in.j;
        case SimdOp::int_and:
            return in.i & in.j;
        case SimdOp::int_or:
            return in.i | in.j;
        case SimdOp::shift_left:
            return in.i << FloatFormat<Real>::mantissa_bits;
        case SimdOp::shift_right:
            return in.i >> FloatFormat<Real>::mantissa_bits;
        case SimdOp::compress_store_int:
            return compressed(in.i, job.mask);
        case SimdOp::to_int:
            return to_int<Real>(in.a);
        case SimdOp::exponent_of:
            return exponent_of(in.a);
        case SimdOp::bits:
            return vint<Real>(static_cast<lane_int<Real>>(bits(in.m)));
        case SimdOp::any:
            return vint<Real>(lane_int<Real>(any(in.m)));
        case SimdOp::none:
            return vint<Real>(lane_int<Real>(none(in.m)));
        case SimdOp::all:
            return vint<Real>(lane_int<Real>(all(in.m)));
        default:
            return vint<Real>(lane_int<Real>(0));
    }
}

template <class Real>
inline void self_test(const abi::SelfTestJob<Real>& job)
{
    const SelfTestOperands<Real> in(job);
    store(job.reals, real_result(job, in));
    alignas(64) lane_int<Real> by_lane[lanes<Real>];
    store(by_lane, int_result(job, in));
    for (int lane = 0; lane < lanes<Real>; ++lane)
        job.integers[lane] = by_lane[lane];
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
