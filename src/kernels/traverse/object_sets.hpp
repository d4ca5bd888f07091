#pragma once

#include <type_traits>

#include "kernels/geometry/cone.hpp"
#include "kernels/traverse/object_lists.hpp"

// What a tile's rays are tested against: with Features::exact objects with their error bounds, else
// what depends on a shared origin alone, computed once.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <abi::Features F, class Real>
using FromPoint = std::conditional_t<F.exact, FilteredObjects<true>, SharedOriginObjects<Real>>;
template <abi::Features F, class Real>
using FromAnywhere = std::conditional_t<F.exact, FilteredObjects<false>, AllObjects<Real>>;

/// What may stand between a light and hits: one of the two, by the light's kind.
template <abi::Features F, class Real>
struct LightObjects {
    FromPoint<F, Real> from_point;
    FromAnywhere<F, Real> along;
};

/// Where a run of rays starts.
inline Origins origins_of(const float* const (&org)[3], int count)
{
    float low[3];
    float high[3];
    for (int axis = 0; axis < 3; ++axis)
        extent(org[axis], count, low[axis], high[axis]);
    return origins_in(low, high);
}

/// Prepares the objects for rays from anywhere in a run of origins.
template <abi::Features F, class Real>
inline void find_nearby(FromAnywhere<F, Real>& objects, const Real* const (&org)[3], int count,
                        const abi::SceneView<Real>& scene)
{
    if constexpr (F.exact)
        find_objects<F>(objects, origins_of(org, count), scene);
    else
        objects.scene = &scene;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
