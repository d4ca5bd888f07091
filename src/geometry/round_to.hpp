#pragma once

#include <packtrace/vec.hpp>

namespace packtrace {

template <class Real>
void round_to(Real (&to)[3], const Vec3& from)
{
    for (int axis = 0; axis < 3; ++axis)
        to[axis] = static_cast<Real>(from[axis]);
}

template <class Real>
[[nodiscard]] Vec3 widen(const Real (&from)[3])
{
    return {from[0], from[1], from[2]};
}

}  // namespace packtrace
