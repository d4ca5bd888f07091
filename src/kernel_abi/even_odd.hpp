#pragma once

#include <cstddef>
#include <initializer_list>
#include <limits>

// Decides without rounding whether a line passes through a polygon. The scalar reference always
// calls this code; packets call it where rounding could change the answer. All functions are
// inlined wherever they are called, so that the kernels have no symbol of them.
namespace packtrace::abi {

/// An exact sum of reals, except for overflow and underflow. It is stored as an expansion: parts
/// that do not overlap, in increasing order, after J. R. Shewchuk, "Adaptive Precision
/// Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete & Computational
/// Geometry 18, 1997. It holds the results of at most `most` calls of add().
template <class Real, std::size_t most>
class ExactSum {
public:
    [[gnu::always_inline]] void add(Real x)
    {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const Real sum = x + part_[i];
            const Real of_x = sum - part_[i];
            const Real error = (part_[i] - (sum - of_x)) + (x - of_x);
            if (error != 0)
                part_[kept++] = error;
            x = sum;
        }
        if (x != 0)
            part_[kept++] = x;
        count_ = kept;
    }

    /// Adds a b. The rounding error of the product is found as in T. J. Dekker, "A Floating-Point
    /// Technique for Extending the Available Precision", Numerische Mathematik 18, 1971, because
    /// not all processors have fused multiply-add.
    [[gnu::always_inline]] void add_product(Real a, Real b)
    {
        if (a == 0 || b == 0)
            return;
        Real error = 0;
        const Real product = rounded_product(a, b, error);
        const Real parts[2] = {error, product};
        for (const Real part : parts)
            add(part);
    }

    /// Adds a b c.
    [[gnu::always_inline]] void add_product(Real a, Real b, Real c)
    {
        Real error = 0;
        const Real product = rounded_product(a, b, error);
        const Real parts[2] = {error, product};
        for (const Real part : parts)
            add_product(part, c);
    }

    /// A real with the sign of the sum; 0 if the sum is 0.
    [[nodiscard, gnu::always_inline]] Real sign() const
    {
        return count_ == 0 ? Real(0) : part_[count_ - 1];
    }

private:
    [[gnu::always_inline]] static Real rounded_product(Real a, Real b, Real& error)
    {
        const Real product = a * b;
        const Real a_high = upper_half(a);
        const Real b_high = upper_half(b);
        const Real a_low = a - a_high;
        const Real b_low = b - b_high;
        error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
        return product;
    }

    /// x rounded to half its digits.
    [[gnu::always_inline]] static Real upper_half(Real x)
    {
        constexpr int digits = (std::numeric_limits<Real>::digits + 1) / 2;
        const Real large = x * (Real(1ull << digits) + 1);
        return large - (large - x);
    }

    Real part_[most];
    std::size_t count_ = 0;
};

/// The even-odd rule for a line: counts how many edges cross a half axis that starts at the line.
/// Corners are projected along the longest axis of the line's direction. A corner on the half axis
/// counts as above it, and an edge through the line counts as not crossing. So polygons that share
/// an edge agree about it, whichever way each of them runs along the edge.
template <class Real>
class EvenOdd {
public:
    [[gnu::always_inline]] EvenOdd(const Real (&org)[3], const Real (&dir)[3])
        : org_{org[0], org[1], org[2]}, dir_{dir[0], dir[1], dir[2]}
    {
        const Real size[3] = {magnitude(dir[0]), magnitude(dir[1]), magnitude(dir[2])};
        const int longest_of_xy = size[0] >= size[1] ? 0 : 1;
        along_ = size[2] >= size[0] && size[2] >= size[1] ? 2 : longest_of_xy;
        across_ = along_ == 0 ? 2 : along_ - 1;
        for (Real longest = size[along_]; longest > large && longest <= largest; longest *= smaller)
            for (Real& component : dir_)
                component *= smaller;
    }

    /// Begins a contour.
    [[gnu::always_inline]] void start(const Real (&corner)[3])
    {
        last_ = seen(corner);
    }

    /// Adds the edge from the last corner to this one.
    [[gnu::always_inline]] void edge_to(const Real (&corner)[3])
    {
        const Corner next = seen(corner);
        if (next.above != last_.above) {
            const Real side = turned(side_of_edge(last_, next));
            inside_ ^= next.above ? side > 0 : side < 0;
        }
        last_ = next;
    }

    [[nodiscard, gnu::always_inline]] bool inside() const
    {
        return inside_;
    }

private:
    static constexpr Real roundoff = std::numeric_limits<Real>::epsilon() / 2;
    /// Longer directions are scaled down by a power of 2, as products with far origins would
    /// overflow.
    static constexpr Real large = 0x1p20;
    static constexpr Real largest = std::numeric_limits<Real>::max();
    static constexpr Real smaller = 0x1p-64;

    /// A corner, and the corner relative to the line's origin, which is rounded.
    struct Corner {
        Real at[3];
        Real off[3];
        bool above;
    };

    /// The rounding error of a corner relative to the origin.
    struct Lost {
        Real off[3];
    };

    [[gnu::always_inline]] static Real magnitude(Real x)
    {
        return x < 0 ? -x : x;
    }

    /// `x`, negated if the direction's longest component is negative.
    [[nodiscard, gnu::always_inline]] Real turned(Real x) const
    {
        return dir_[along_] < 0 ? -x : x;
    }

    [[nodiscard, gnu::always_inline]] Corner seen(const Real (&corner)[3]) const
    {
        Corner result;
        for (int i = 0; i < 3; ++i) {
            result.at[i] = corner[i];
            result.off[i] = corner[i] - org_[i];
        }
        result.above = turned(height(result)) >= 0;
        return result;
    }

    [[nodiscard, gnu::always_inline]] Lost lost_of(const Corner& corner) const
    {
        Lost lost;
        for (int i = 0; i < 3; ++i) {
            const Real of_org = corner.off[i] - corner.at[i];
            lost.off[i] = (corner.at[i] - (corner.off[i] - of_org)) - (org_[i] + of_org);
        }
        return lost;
    }

    /// A real with the sign of v d_z - z d_v, where z is the longest axis and v the second axis
    /// after it.
    [[nodiscard, gnu::always_inline]] Real height(const Corner& corner) const
    {
        const Real across = corner.off[across_] * dir_[along_];
        const Real along = corner.off[along_] * dir_[across_];
        const Real rounded = across - along;
        // Two differences and a product round once each.
        if (magnitude(rounded) > 4 * roundoff * (magnitude(across) + magnitude(along)))
            return rounded;
        const Lost lost = lost_of(corner);
        ExactSum<Real, 8> sum;
        for (const Real* part : {corner.off, lost.off}) {
            sum.add_product(part[across_], dir_[along_]);
            sum.add_product(part[along_], -dir_[across_]);
        }
        return sum.sign();
    }

    /// A real with the sign of (a x b)·d.
    [[nodiscard, gnu::always_inline]] Real side_of_edge(const Corner& a, const Corner& b) const
    {
        Real rounded = 0;
        Real size = 0;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            const int k = (i + 2) % 3;
            const Real left = a.off[j] * b.off[k];
            const Real right = a.off[k] * b.off[j];
            rounded += (left - right) * dir_[i];
            size += (magnitude(left) + magnitude(right)) * magnitude(dir_[i]);
        }
        // Each of the six terms is rounded at most seven times.
        if (magnitude(rounded) > 8 * roundoff * size)
            return rounded;
        return exact_side_of_edge(a, b);
    }

    [[nodiscard, gnu::always_inline]] Real exact_side_of_edge(const Corner& a,
                                                              const Corner& b) const
    {
        const Lost lost_a = lost_of(a);
        const Lost lost_b = lost_of(b);
        ExactSum<Real, 96> sum;
        for (const Real* from : {a.off, lost_a.off})
            for (const Real* to : {b.off, lost_b.off})
                for (int i = 0; i < 3; ++i) {
                    const int j = (i + 1) % 3;
                    const int k = (i + 2) % 3;
                    sum.add_product(from[j], to[k], dir_[i]);
                    sum.add_product(from[k], to[j], -dir_[i]);
                }
        return sum.sign();
    }

    Real org_[3];
    Real dir_[3];
    int along_ = 0;   ///< the longest axis
    int across_ = 0;  ///< the second axis after it
    Corner last_{};
    bool inside_ = false;
};

}  // namespace packtrace::abi
