#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

// Where a line hits one surface: the roots of its equation, clipped and capped.
namespace packtrace::reference {

/// A piece of a surface; only a capped quadric has more than its side.
enum class Part { side, low_cap, high_cap };

/// The hits of a line with one surface, by increasing t: at most two roots of a quadratic and two
/// caps. Equal t stay in the order of adding, which is the order in which the line passes them.
template <class Real>
struct Roots {
    struct Root {
        Real t;
        Part part;
        bool leaving;  ///< the line comes from the inside, by the slope of the equation
    };
    Root root[4];
    int count = 0;

    /// Ignores an infinite t or a NaN, as of a parallel plane.
    void add(const Root& added)
    {
        if (!std::isfinite(added.t))
            return;
        int index = count++;
        for (; index > 0 && root[index - 1].t > added.t; --index)
            root[index] = root[index - 1];
        root[index] = added;
    }
    [[nodiscard]] const Root* begin() const
    {
        return root;
    }
    [[nodiscard]] const Root* end() const
    {
        return root + count;
    }
};

/// Where the left side of a surface's equation is negative along a line: between its two roots, or
/// before the first and behind the last. A root that does not exist is infinite. The default is a
/// line that is inside everywhere.
template <class Real>
struct Interior {
    Real first = -std::numeric_limits<Real>::infinity();
    Real last = std::numeric_limits<Real>::infinity();
    bool between = true;
};

/// The interior of a line that is inside nowhere.
template <class Real>
[[nodiscard]] Interior<Real> no_interior()
{
    constexpr Real infinite = std::numeric_limits<Real>::infinity();
    return {infinite, -infinite, true};
}

/// The interior for 2 b t + c.
template <class Real>
[[nodiscard]] Interior<Real> interior_of_line(Real b, Real c)
{
    if (b == 0)
        return c < 0 ? Interior<Real>() : no_interior<Real>();
    Interior<Real> interior;
    (b > 0 ? interior.last : interior.first) = -c / (2 * b);
    return interior;
}

/// The interior for a t² + 2 b t + c with a != 0. `discriminant` is b² - a c, computed as exactly
/// as the surface allows.
template <class Real>
[[nodiscard]] Interior<Real> interior_of_parabola(Real a, Real b, Real c, Real discriminant)
{
    if (!(discriminant >= 0))
        return a < 0 && discriminant < 0 ? Interior<Real>() : no_interior<Real>();
    const Real root = std::sqrt(discriminant);
    // If b is about as large as the root, one of the two sums cancels, and Press' q does not
    // (Numerical Recipes, section 5.6). If b is smaller, c may be nothing but rounding error. The
    // same holds if c / q, which should be the root of smaller magnitude, comes out larger.
    const Real q = -(b + std::copysign(root, b));
    const bool cancels = std::abs(b) > root / 2 && std::abs(a * c) <= q * q;
    const Real t0 = cancels ? q / a : (-b - root) / a;
    const Real t1 = cancels ? c / q : (-b + root) / a;
    return {std::min(t0, t1), std::max(t0, t1), a > 0};
}

/// Where a line is between the two planes that clip a surface, and the caps by which it enters and
/// leaves. The default clips nothing.
template <class Real>
struct Slab {
    Real enter = -std::numeric_limits<Real>::infinity();
    Real leave = std::numeric_limits<Real>::infinity();
    Part enters_by = Part::low_cap;
    Part leaves_by = Part::high_cap;
    bool capped = false;
};

/// The hits of a line with the surface around `interior`, clipped to `slab`, and with its caps.
/// Side and caps are decided by the same t, so that a line enters and leaves by turns. At the edge
/// of side and cap the side is hit. A line that touches the edge hits side and cap.
template <class Real>
[[nodiscard]] Roots<Real> clipped_roots(const Interior<Real>& interior, const Slab<Real>& slab)
{
    const auto& [first, last, between] = interior;
    const auto& [enter, leave, enters_by, leaves_by, capped] = slab;
    Roots<Real> roots;
    if (capped && (between ? first < enter && enter <= last : enter <= first || enter > last))
        roots.add({.t = enter, .part = enters_by, .leaving = false});
    if (enter <= first && first <= leave)
        roots.add({.t = first, .part = Part::side, .leaving = !between});
    if (enter <= last && last <= leave)
        roots.add({.t = last, .part = Part::side, .leaving = between});
    if (capped && (between ? first <= leave && leave < last : leave < first || leave >= last))
        roots.add({.t = leave, .part = leaves_by, .leaving = true});
    return roots;
}

}  // namespace packtrace::reference
