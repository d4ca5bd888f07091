#pragma once

#include "core/quad.hpp"
#include <packtrace/vec.hpp>

namespace packtrace {

/// The minor of an entry, with its sign. In double the minors of an ill-conditioned matrix lose
/// digits, and no kernel can recover them.
[[nodiscard]] inline Quad exact_minor(const Mat3& m, int column, int row)
{
    const int c1 = (column + 1) % 3;
    const int c2 = (column + 2) % 3;
    const int r1 = (row + 1) % 3;
    const int r2 = (row + 2) % 3;
    return Quad(m[c1][r1]) * m[c2][r2] - Quad(m[c1][r2]) * m[c2][r1];
}

[[nodiscard]] inline Quad exact_determinant(const Mat3& m)
{
    return m[0][0] * exact_minor(m, 0, 0) + m[0][1] * exact_minor(m, 0, 1) +
           m[0][2] * exact_minor(m, 0, 2);
}

}  // namespace packtrace
