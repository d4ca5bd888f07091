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

/// The sum of a run of values.
inline float sum_of(const float* values, int count)
{
    vreal<float> total(0.0f);
    int i = 0;
    for (; i + lanes<float> <= count; i += lanes<float>)
        total = total + load(values + i);
    if (i < count)
        total = select(from_bits<float>(first_lanes<float>(count - i)), total + load(values + i),
                       total);
    alignas(64) float by_lane[lanes<float>];
    store(by_lane, total);
    float sum = 0;
    for (const float value : by_lane)
        sum += value;
    return sum;
}

/// Directions further apart than this from their middle bound next to nothing.
inline constexpr float least_cosine2 = 0.02f;
/// How much the square of a cosine may be off through rounding, with a margin.
inline constexpr float cosine2_slack = 2e-6f;

/// The least square of the cosine between the directions and a unit axis; below `least_cosine2` if
/// that is so of any, or if it is no number.
inline float narrowest_cosine2(const float* const (&dir)[3], int count, const float (&axis)[3])
{
    const Vec3v<float> middle = broadcast(axis);
    vreal<float> least(1.0f);
    for (int i = 0; i < count; i += lanes<float>) {
        const Vec3v<float> d{load(dir[0] + i), load(dir[1] + i), load(dir[2] + i)};
        const vreal<float> along = dot(middle, d);
        const vreal<float> cosine2 = along * abs(along) / dot(d, d);
        const std::uint32_t live = first_lanes<float>(count - i);
        if ((live & ~bits(cosine2 >= vreal<float>(least_cosine2))) != 0)
            return 0.0f;
        least = select(from_bits<float>(live), min(least, cosine2), least);
    }
    float low;
    float high;
    extent_of_lanes<float>(least, least, low, high);
    return low;
}

/// The cone of a run of rays from `origins`.
inline Cone<float> cone_of(const Origins& origins, const float* const (&dir)[3], int count)
{
    Cone<float> cone;
    for (int axis = 0; axis < 3; ++axis) {
        cone.base[axis] = origins.center[axis];
        cone.axis[axis] = sum_of(dir[axis], count);
    }
    cone.radius = origins.radius;
    const float length = square_root(cone.axis[0] * cone.axis[0] + cone.axis[1] * cone.axis[1] +
                                     cone.axis[2] * cone.axis[2]);
    for (float& component : cone.axis)
        component /= length;
    const float cosine2 = narrowest_cosine2(dir, count, cone.axis) - cosine2_slack;
    if (!(cosine2 >= least_cosine2 - cosine2_slack))
        return cone;
    cone.cosine = square_root(cosine2);
    cone.sine = square_root(1.0f - cosine2);
    cone.reach = __builtin_inff();
    cone.bounded = true;
    return cone;
}

/// Prepares the objects for all rays from a point, wherever they go.
template <abi::Features F, class Real>
inline void find_from_point(FromPoint<F, Real>& objects, const Real (&point)[3],
                            const abi::SceneView<Real>& scene)
{
    Cone<Real> anywhere;
    for (int axis = 0; axis < 3; ++axis)
        anywhere.base[axis] = point[axis];
    find_objects<F>(objects, anywhere, scene);
}

/// Prepares the objects for a run of rays.
template <abi::Features F, class Real>
inline void find_nearby(FromAnywhere<F, Real>& objects, const Real* const (&org)[3],
                        const Real* const (&dir)[3], int count, const abi::SceneView<Real>& scene)
{
    if constexpr (F.exact) {
        const Origins origins = origins_of(org, count);
        filter_objects<F, false>(objects, origins, cone_of(origins, dir, count), scene);
    } else {
        objects.scene = &scene;
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
