#pragma once

#include "kernel_abi/features.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernels/geometry/anchored_sphere_filter.hpp"
#include "kernels/geometry/candidates.hpp"
#include "kernels/geometry/plane_filter.hpp"
#include "kernels/geometry/quadric_filter.hpp"
#include "kernels/traverse/shared_origin.hpp"

// The objects of a scene's lists with the error bounds of one group of rays: of those from one
// point, or of those from anywhere in a ball.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Spheres with their bounds, in rising order. `x, y, z` is a shared origin relative to the centre,
/// else the centre.
struct SphereFilters {
    float* x = nullptr;
    float* y = nullptr;
    float* z = nullptr;
    float* radius2 = nullptr;
    SphereBounds<float*> bounds = {};
    std::int32_t* surface = nullptr;
    int count = 0;
};

template <bool Shared>
struct FilteredObjects {
    static constexpr bool shared = Shared;

    SphereFilters spheres;
    AnchoredFilter* anchored_spheres = nullptr;
    PlaneFilter* planes = nullptr;
    QuadricFilter* quadrics = nullptr;
    int anchored_count = 0;
    int plane_count = 0;
    int quadric_count = 0;
    bool certifiable = false;  ///< the scene's sizes and the origins are such that bounds hold

    bool empty() const
    {
        return spheres.count + anchored_count + plane_count + quadric_count == 0;
    }
};

/// The bounds of a packet of spheres go where the lanes of `kept` go.
inline void append_bounds(SphereFilters& list, std::uint32_t kept,
                          const SphereBounds<vreal<float>>& bounds)
{
    compress_store(list.bounds.outer2 + list.count, kept, bounds.outer2);
    compress_store(list.bounds.inner2 + list.count, kept, bounds.inner2);
    compress_store(list.bounds.along + list.count, kept, bounds.along);
    compress_store(list.bounds.moment + list.count, kept, bounds.moment);
    compress_store(list.bounds.size + list.count, kept, bounds.size);
    compress_store(list.bounds.band2 + list.count, kept, bounds.band2);
}

/// A shared origin relative to a packet of centres, rounded once.
inline Vec3v<float> origin_from_centers(const Origins& origins,
                                        const abi::SphereListView<double>& wide, int first)
{
    const auto from = [&](int axis, const double* center) {
        const vreal<double> origin(double{origins.center[axis]});
        return narrow(origin - load(center + first), origin - load(center + first + lanes<double>));
    };
    return {from(0, wide.center_x), from(1, wide.center_y), from(2, wide.center_z)};
}

/// Fills a list with the spheres that a cone may meet, or with all where it is not bounded.
template <bool Shared>
inline void filter_spheres(SphereFilters& list, const Origins& origins, const Cone<float>& cone,
                           const abi::SphereListView<float>& spheres,
                           const abi::SphereListView<double>& wide)
{
    list.count = 0;
    for_each_met(cone, spheres, [&](int first, std::uint32_t kept, const Vec3v<float>& center) {
        const Vec3v<float> w =
            Shared ? origin_from_centers(origins, wide, first) : broadcast(origins.center) - center;
        const vreal<float> error = Shared ? vreal<float>(0.0f) : load(spheres.center_error + first);
        const vreal<float> length =
            (sqrt(dot(w, w)) + vreal<float>(origins.radius)) * vreal<float>(inflation) + error;
        const vreal<float> radius = load(spheres.radius + first);
        const Vec3v<float> place = Shared ? w : center;
        compress_store(list.x + list.count, kept, place.x);
        compress_store(list.y + list.count, kept, place.y);
        compress_store(list.z + list.count, kept, place.z);
        compress_store(list.radius2 + list.count, kept, load(spheres.radius2 + first));
        compress_store(list.surface + list.count, kept, load(spheres.surface + first));
        append_bounds(list, kept, sphere_bounds(radius, error, moment_error(error, length)));
        list.count += __builtin_popcount(kept);
    });
}

/// Whether all rays of a cone leave an anchored sphere behind: they start outside and go the way
/// of its outward gradient.
inline bool leaves_behind(const Cone<float>& cone, const AnchoredFilter& sphere)
{
    const float inwards[3] = {-sphere.gradient[0], -sphere.gradient[1], -sphere.gradient[2]};
    return sphere.value > sphere.value_error && runs_against(cone, inwards);
}

/// The same of a plane: they run away from it on the side they start on.
inline bool leaves_behind(const Cone<float>& cone, const PlaneFilter& plane)
{
    const float side = plane.height < 0 ? -1.0f : 1.0f;
    const float towards[3] = {side * plane.normal[0], side * plane.normal[1],
                              side * plane.normal[2]};
    return side * plane.height > plane.height_error && runs_against(cone, towards);
}

/// Fills `objects` with what rays from `origins` may meet; `cone` bounds rays from one point, and
/// spheres alone of others.
template <abi::Features F, bool Shared>
[[gnu::noinline]] void filter_objects(FilteredObjects<Shared>& objects, const Origins& origins,
                                      const Cone<float>& cone, const abi::SceneView<float>& scene)
{
    const abi::GeometryView<double>& wide = *scene.wide;
    objects.certifiable = scene.certifiable && certifiable(origins);
    filter_spheres<Shared>(objects.spheres, origins, cone, scene.spheres, wide.spheres);
    objects.anchored_count = 0;
    for (int i = 0; i < wide.anchored_spheres.count; ++i) {
        AnchoredFilter& filter = objects.anchored_spheres[objects.anchored_count];
        filter = anchored_filter<Shared>(wide.anchored_spheres.data[i], origins);
        objects.anchored_count += !(Shared && leaves_behind(cone, filter));
    }
    objects.plane_count = 0;
    for (int i = 0; i < wide.planes.count; ++i) {
        PlaneFilter& filter = objects.planes[objects.plane_count];
        filter = plane_filter<Shared>(wide.planes.data[i], origins);
        objects.plane_count += !(Shared && leaves_behind(cone, filter));
    }
    objects.quadric_count = 0;
    if constexpr (F.quadrics)
        for (int i = 0; i < wide.quadrics.count; ++i) {
            const abi::QuadricRecord<float>& record = scene.quadrics.data[i];
            const Vec3v<float> to_bound = broadcast(record.bound) - broadcast(cone.base);
            if (Shared && cone.bounded &&
                none(may_meet<float>(cone, to_bound, vreal<float>(record.bound_radius))))
                continue;
            objects.quadrics[objects.quadric_count++] =
                quadric_filter<Shared>(record, wide.quadrics.data[i], origins);
        }
}

/// What the rays of a cone from one point may meet.
template <abi::Features F>
inline void find_objects(FilteredObjects<true>& objects, const Cone<float>& cone,
                         const abi::SceneView<float>& scene)
{
    Origins origins;
    for (int axis = 0; axis < 3; ++axis)
        origins.center[axis] = cone.base[axis];
    filter_objects<F, true>(objects, origins, cone, scene);
}

/// What rays from `origins` may meet, wherever they go.
template <abi::Features F>
inline void find_objects(FilteredObjects<false>& objects, const Origins& origins,
                         const abi::SceneView<float>& scene)
{
    filter_objects<F, false>(objects, origins, Cone<float>{}, scene);
}

/// One sphere of a list for a packet of rays.
template <bool Shared>
inline Vec3v<float> origin_from(const SphereFilters& list, int i, const RayPacket<float>& rays)
{
    const Vec3v<float> place{vreal<float>(list.x[i]), vreal<float>(list.y[i]),
                             vreal<float>(list.z[i])};
    return Shared ? place : rays.org - place;
}

inline SphereTest test_of(const SphereFilters& list, int i, const Vec3v<float>& w)
{
    return {w,
            vreal<float>(list.radius2[i]),
            {vreal<float>(list.bounds.outer2[i]), vreal<float>(list.bounds.inner2[i]),
             vreal<float>(list.bounds.along[i]), vreal<float>(list.bounds.moment[i]),
             vreal<float>(list.bounds.size[i]), vreal<float>(list.bounds.band2[i])}};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
