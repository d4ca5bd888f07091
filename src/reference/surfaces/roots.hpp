#pragma once

#include <cmath>

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

}  // namespace packtrace::reference
