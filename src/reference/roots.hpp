#pragma once

#include <cmath>

namespace packtrace::reference {

/// Which piece of a surface a ray meets; only a capped quadric has more than its side.
enum class Part { side, low_cap, high_cap };

/// Where a line meets one surface, in no order: at most two roots of a quadratic and two caps.
template <class Real>
struct Roots {
    struct Root {
        Real t;
        Part part;
    };
    Root root[4];
    int count = 0;

    /// Leaves out an infinite or undefined t, as a parallel plane has.
    void add(Real t, Part part = Part::side)
    {
        if (std::isfinite(t))
            root[count++] = {t, part};
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

}  // namespace packtrace::reference
