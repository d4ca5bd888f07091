#pragma once

#include "kernels/geometry/cone.hpp"
#include "kernels/lists/object_lists.hpp"
#include "kernels/simd/stream_values.hpp"

#include <type_traits>

// The types of the objects that a tile's rays are tested against: with Features::exact objects with
// error bounds, else objects with values that depend on a shared origin.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <abi::Features F, class Real>
using FromPoint =
    std::conditional_t<F.exact, FilteredObjects<Origin::shared>, SharedOriginObjects<Real>>;
template <abi::Features F, class Real>
using FromAnywhere =
    std::conditional_t<F.exact, FilteredObjects<Origin::any>, SelectedObjects<Real>>;

/// The possible occluders between a light and hits. Which of the two is used depends on the light.
template <abi::Features F, class Real>
struct LightObjects {
    FromPoint<F, Real> from_point;
    FromAnywhere<F, Real> along;
    bool are_all;  ///< they include all objects of the BVH that may be occluders
};

/// The bounding box of consecutive values.
template <class Real>
inline Box<Real> box_of_run(const Real* const (&org)[3], int count)
{
    Box<Real> box;
    for (int axis = 0; axis < 3; ++axis)
        extent(org[axis], count, box.low[axis], box.high[axis]);
    return box;
}

/// The sum of consecutive values.
template <class Real>
inline Real sum_of(const Real* values, int count)
{
    vreal<Real> total(Real(0));
    int i = 0;
    for (; i + lanes<Real> <= count; i += lanes<Real>)
        total = total + load(values + i);
    if (i < count)
        total = select(from_bits<Real>(first_lanes<Real>(count - i)),
                       total + load_some(values + i, count - i), total);
    alignas(64) Real by_lane[lanes<Real>];
    store(by_lane, total);
    Real sum = 0;
    for (const Real value : by_lane)
        sum += value;
    return sum;
}

/// Directions further than this from their mean are not worth a bound.
template <class Real>
inline constexpr Real least_cosine2 = Real(0.02);
/// The error of the square of a cosine, with a margin.
template <class Real>
inline constexpr Real cosine2_slack = Real(2e-6);

/// The smallest squared cosine between the directions and a unit axis. Below `least_cosine2` if any
/// is, or if any is NaN.
template <class Real>
inline Real narrowest_cosine2(const Real* const (&dir)[3], int count, const Real (&axis)[3])
{
    const Vec3v<Real> middle = broadcast(axis);
    vreal<Real> least(Real(1));
    for (int i = 0; i < count; i += lanes<Real>) {
        const Vec3v<Real> d = load_some3(dir, i, count - i);
        const vreal<Real> along = dot(middle, d);
        const vreal<Real> cosine2 = along * abs(along) / dot(d, d);
        const std::uint32_t live = first_lanes<Real>(count - i);
        if ((live & ~bits(cosine2 >= vreal<Real>(least_cosine2<Real>))) != 0)
            return Real(0);
        least = select(from_bits<Real>(live), min(least, cosine2), least);
    }
    Real low;
    Real high;
    extent_of_lanes<Real>(least, least, low, high);
    return low;
}

/// The cone of consecutive rays whose origins lie in a ball.
template <class Real>
inline Cone<Real> cone_of(const Real (&center)[3], Real radius, const Real* const (&dir)[3],
                          int count)
{
    Cone<Real> cone;
    for (int axis = 0; axis < 3; ++axis) {
        cone.base[axis] = center[axis];
        cone.axis[axis] = sum_of(dir[axis], count);
    }
    cone.radius = radius;
    const Real length = square_root(cone.axis[0] * cone.axis[0] + cone.axis[1] * cone.axis[1] +
                                    cone.axis[2] * cone.axis[2]);
    for (Real& component : cone.axis)
        component /= length;
    const Real cosine2 = narrowest_cosine2(dir, count, cone.axis) - cosine2_slack<Real>;
    if (!(cosine2 >= least_cosine2<Real> - cosine2_slack<Real>))
        return cone;
    cone.cosine = square_root(cosine2);
    cone.sine = square_root(Real(1) - cosine2);
    cone.reach = static_cast<Real>(__builtin_inf());
    cone.bounded = true;
    return cone;
}

/// Prepares the objects for rays from a point in any direction.
template <abi::Features F, class Real>
inline void find_from_point(FromPoint<F, Real>& objects, const Real (&point)[3],
                            const abi::SceneView<Real>& scene)
{
    Cone<Real> anywhere;
    for (int axis = 0; axis < 3; ++axis)
        anywhere.base[axis] = point[axis];
    find_objects<F>(objects, anywhere, scene);
}

/// The cone of consecutive rays whose origins lie in a box.
template <abi::Features F, class Real>
inline Cone<Real> cone_nearby(const Box<Real>& box, const Real* const (&dir)[3], int count)
{
    if constexpr (F.exact) {
        const Origins origins = origins_in(box.low, box.high);
        return cone_of(origins.center, origins.radius, dir, count);
    } else {
        const Ball<Real> ball = ball_around(box);
        return cone_of(ball.center, ball.radius, dir, count);
    }
}

/// Prepares the objects for rays of a cone whose origins lie in a box.
template <abi::Features F, class Real>
inline void find_nearby(FromAnywhere<F, Real>& objects, const Box<Real>& box,
                        const Cone<Real>& cone, const abi::SceneView<Real>& scene)
{
    if constexpr (F.exact)
        filter_objects<F, Origin::any>(objects, origins_in(box.low, box.high), cone, scene);
    else
        find_objects<F>(objects, cone, scene);
}

/// The cone of shadow rays that start at points in a box.
template <class Real>
inline Cone<Real> cone_along(const Box<Real>& box, const abi::LightRecord<Real>& light)
{
    return light.kind == abi::LightKind::point ? cone_to(light.vector, box)
                                               : parallel_cone(light.vector, box);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
