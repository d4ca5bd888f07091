#pragma once

#include "reference/glass_stack.hpp"
#include "reference/start.hpp"

namespace packtrace::reference {

/// A ray of the models that know glass.
template <class Real>
struct Ray {
    Vec3<Real> org;
    Vec3<Real> dir;  ///< unit
    GlassStack inside;
    Departure<Real> left = {};  ///< what it leaves; nothing for a ray from the eye
};

}  // namespace packtrace::reference
