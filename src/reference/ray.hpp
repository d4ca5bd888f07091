#pragma once

#include "reference/glass_stack.hpp"
#include "reference/vec3.hpp"

namespace packtrace::reference {

/// A ray of the models that know glass.
template <class Real>
struct Ray {
    Vec3<Real> org;
    Vec3<Real> dir;  ///< unit
    GlassStack inside;
};

}  // namespace packtrace::reference
