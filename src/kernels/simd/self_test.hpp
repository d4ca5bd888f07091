#pragma once

#include "kernel_abi/self_test.hpp"
#include "kernels/simd/float_bits.hpp"
#include "kernels/simd/vec3.hpp"

// Runs single operations. Tests compare them with plain scalar code.
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

/// The packet that compress_store writes to memory.
template <class Packet>
inline Packet compressed(const Packet& x, std::uint32_t pattern)
{
    alignas(64) typename Packet::value_type by_lane[Packet::size];
    compress_store(by_lane, pattern, x);
    return load(by_lane);
}

/// a b - c computed in double for floats, by widening and narrowing.
inline vreal<float> by_halves(const SelfTestOperands<float>& in)
{
    return narrow(widen_low(in.a) * widen_low(in.b) - widen_low(in.c),
                  widen_high(in.a) * widen_high(in.b) - widen_high(in.c));
}
inline vreal<double> by_halves(const SelfTestOperands<double>& in)
{
    return in.a * in.b - in.c;
}

// SimdOp lists arithmetic first, up to `max`, then comparisons and operations on masks, up to
// `mask_not`.

template <class Real>
inline vreal<Real> arithmetic_result(abi::SimdOp op, const SelfTestOperands<Real>& in)
{
    using abi::SimdOp;
    switch (op) {
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
        default:
            return max(in.a, in.b);
    }
}

template <class Real>
inline vmask<Real> mask_result(abi::SimdOp op, const SelfTestOperands<Real>& in)
{
    using abi::SimdOp;
    const vmask<Real> other = in.b < in.c;
    switch (op) {
        case SimdOp::less:
            return in.a < in.b;
        case SimdOp::less_equal:
            return in.a <= in.b;
        case SimdOp::greater:
            return in.a > in.b;
        case SimdOp::greater_equal:
            return in.a >= in.b;
        case SimdOp::equal:
            return in.a == in.b;
        case SimdOp::mask_and:
            return in.m & other;
        case SimdOp::mask_or:
            return in.m | other;
        case SimdOp::either:
            return either(in.m, other);
        case SimdOp::mask_and_not:
            return in.m & !other;
        default:
            return !in.m;
    }
}

/// The other operations whose result is a packet of reals or a mask.
template <class Real>
inline vreal<Real> other_result(const abi::SelfTestJob<Real>& job, const SelfTestOperands<Real>& in)
{
    using abi::SimdOp;
    switch (job.op) {
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

template <class Real>
inline vreal<Real> real_result(const abi::SelfTestJob<Real>& job, const SelfTestOperands<Real>& in)
{
    if (job.op <= abi::SimdOp::max)
        return arithmetic_result(job.op, in);
    if (job.op <= abi::SimdOp::mask_not)
        return in.as_numbers(mask_result(job.op, in));
    return other_result(job, in);
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
