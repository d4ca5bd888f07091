#pragma once

#include "kernels/simd/simd.hpp"

// a b - c, exact if c is so close to a b that the difference is representable. It is one fused
// operation or, without FMA, Dekker's product (T. J. Dekker, "A Floating-Point Technique for
// Extending the Available Precision", 1971).
namespace packtrace::PACKTRACE_ISA {
namespace {

#if defined(__FMA__) || defined(__aarch64__)

template <class Real>
inline batch<Real> exact_msub(batch<Real> a, batch<Real> b, batch<Real> c)
{
    return msub(a, b, c);
}

#else

/// x as the sum of two reals with half the digits each.
template <class Real>
struct Halves {
    vreal<Real> high;
    vreal<Real> low;

    explicit Halves(const vreal<Real>& x)
    {
        constexpr Real splitter = sizeof(Real) == 4 ? Real(0x1p12 + 1) : Real(0x1p27 + 1);
        const vreal<Real> large = vreal<Real>(splitter) * x;
        high = large - (large - x);
        low = x - high;
    }
};

template <class Real>
inline batch<Real> exact_msub(batch<Real> a, batch<Real> b, batch<Real> c)
{
    const Halves<Real> p(a);
    const Halves<Real> q(b);
    const vreal<Real> product = a * b;
    const vreal<Real> high = p.high * q.high - product;
    const vreal<Real> error = ((high + p.high * q.low) + p.low * q.high) + p.low * q.low;
    return (product - c) + error;
}

#endif

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
