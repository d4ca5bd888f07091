#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

// Where a line meets one surface: the roots of its equation, clipped and capped.
namespace packtrace::reference {

/// Which piece of a surface a ray meets; only a capped quadric has more than its side.
enum class Part { side, low_cap, high_cap };

/// Where a line meets one surface, by increasing t: at most two roots of a quadratic and two
/// caps. Among equal t the order of adding stays, which is the one in which the line passes them.
template <class Real>
struct Roots {
    struct Root {
        Real t;
        Part part;
        bool leaving;  ///< the line comes from the inside there, as the equation's slope says
    };
    Root root[4];
    int count = 0;

    /// Leaves out an infinite or undefined t, as a parallel plane has.
    void add(Real t, Part part, bool leaving)
    {
        if (!std::isfinite(t))
            return;
        int place = count++;
        for (; place > 0 && root[place - 1].t > t; --place)
            root[place] = root[place - 1];
        root[place] = {t, part, leaving};
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
/// before the first and behind the last. A root that does not exist is infinite.
template <class Real>
struct Interior {
    Real first = -std::numeric_limits<Real>::infinity();
    Real last = std::numeric_limits<Real>::infinity();
    bool between = true;
};

/// The interior of a line that is inside everywhere or nowhere.
template <class Real>
[[nodiscard]] Interior<Real> without_roots(bool inside)
{
    constexpr Real infinite = std::numeric_limits<Real>::infinity();
    return inside ? Interior<Real>{-infinite, infinite, true}
                  : Interior<Real>{infinite, -infinite, true};
}

/// The interior for 2 b t + c.
template <class Real>
[[nodiscard]] Interior<Real> interior_of_line(Real b, Real c)
{
    if (b == 0)
        return without_roots<Real>(c < 0);
    Interior<Real> interior;
    (b > 0 ? interior.last : interior.first) = -c / (2 * b);
    return interior;
}

/// The interior for a t² + 2 b t + c with a != 0; `discriminant` is b² - a c, as exact as the
/// surface's form gives it.
template <class Real>
[[nodiscard]] Interior<Real> interior_of_parabola(Real a, Real b, Real c, Real discriminant)
{
    if (!(discriminant >= 0))
        return without_roots<Real>(a < 0 && discriminant < 0);
    const Real root = std::sqrt(discriminant);
    // Where b and the root are of one size, one of the two sums cancels, and Press' q does not
    // (Numerical Recipes, section 5.6). Where b is the lesser, c may be nothing but rounding, and
    // so it is where c / q, by size the lesser root, seems to be the larger.
    const Real q = -(b + std::copysign(root, b));
    const bool cancels = std::abs(b) > root / 2 && std::abs(a * c) <= q * q;
    const Real t0 = cancels ? q / a : (-b - root) / a;
    const Real t1 = cancels ? c / q : (-b + root) / a;
    return {std::min(t0, t1), std::max(t0, t1), a > 0};
}

/// Where a line is between the planes that clip a surface, and by which it comes and goes.
template <class Real>
struct Slab {
    Real enter = -std::numeric_limits<Real>::infinity();
    Real leave = std::numeric_limits<Real>::infinity();
    Part enters_by = Part::low_cap;
    Part leaves_by = Part::high_cap;
};

/// For a line at height `z` that climbs `climb` a unit of t.
template <class Real>
[[nodiscard]] Slab<Real> slab_of(Real low, Real high, Real z, Real climb)
{
    constexpr Real infinite = std::numeric_limits<Real>::infinity();
    if (climb == 0)
        return low <= z && z <= high ? Slab<Real>{} : Slab<Real>{infinite, -infinite};
    if (climb > 0)
        return {(low - z) / climb, (high - z) / climb, Part::low_cap, Part::high_cap};
    return {(high - z) / climb, (low - z) / climb, Part::high_cap, Part::low_cap};
}

/// Where a line meets the surface around `interior`, clipped to `slab`, with caps if it has them.
/// Side and caps are decided by the same numbers t, so that a line goes in and out in turns: at
/// their common edge the side counts, and the cap only where the line touches the edge, which it
/// then meets twice.
template <class Real>
[[nodiscard]] Roots<Real> clipped_roots(const Interior<Real>& interior, const Slab<Real>& slab,
                                        bool capped)
{
    const auto& [first, last, between] = interior;
    const auto& [enter, leave, enters_by, leaves_by] = slab;
    Roots<Real> roots;
    if (capped && (between ? first < enter && enter <= last : enter <= first || enter > last))
        roots.add(enter, enters_by, false);
    if (enter <= first && first <= leave)
        roots.add(first, Part::side, !between);
    if (enter <= last && last <= leave)
        roots.add(last, Part::side, between);
    if (capped && (between ? first <= leave && leave < last : leave < first || leave >= last))
        roots.add(leave, leaves_by, true);
    return roots;
}

}  // namespace packtrace::reference
