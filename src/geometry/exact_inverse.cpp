#include "geometry/exact_inverse.hpp"

#include "core/quad.hpp"

namespace packtrace {
namespace {

Quad minor_of(const Mat3& m, int column, int row)
{
    const int c1 = (column + 1) % 3;
    const int c2 = (column + 2) % 3;
    const int r1 = (row + 1) % 3;
    const int r2 = (row + 2) % 3;
    return Quad(m[c1][r1]) * m[c2][r2] - Quad(m[c1][r2]) * m[c2][r1];
}

}  // namespace

Mat3 exact_inverse(const Mat3& m)
{
    const Quad determinant =
        m[0][0] * minor_of(m, 0, 0) + m[0][1] * minor_of(m, 0, 1) + m[0][2] * minor_of(m, 0, 2);
    Mat3 inverse;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            inverse[column][row] =
                static_cast<double>(Quad(minor_of(m, row, column) / determinant));
    return inverse;
}

}  // namespace packtrace
