#pragma once

#include "kernels/geometry/sphere_filter.hpp"

// Lists of spheres with error bounds.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Spheres with their error bounds, in order of surface numbers or sorted by distance. `x, y, z` is
/// a shared origin relative to the centre, else the centre.
struct SphereFilters {
    float* x = nullptr;
    float* y = nullptr;
    float* z = nullptr;
    float* radius2 = nullptr;
    SphereBounds<float*> bounds = {};
    float* distance = nullptr;  ///< if sorted: lower bound of the distance from the shared origin
    std::int32_t* surface = nullptr;
    int count = 0;
    bool sorted = false;
};

/// Appends the bounds of the lanes of `kept` of a packet of spheres; does not change the count.
inline void append_bounds(SphereFilters& list, std::uint32_t kept,
                          const SphereBounds<vreal<float>>& bounds)
{
    compress_store(list.bounds.outer2 + list.count, kept, bounds.outer2);
    compress_store(list.bounds.inner2 + list.count, kept, bounds.inner2);
    compress_store(list.bounds.along + list.count, kept, bounds.along);
    compress_store(list.bounds.moment + list.count, kept, bounds.moment);
    compress_store(list.bounds.size + list.count, kept, bounds.size);
    compress_store(list.bounds.band2 + list.count, kept, bounds.band2);
    compress_store(list.bounds.reach + list.count, kept, bounds.reach);
}

/// A packet of spheres, for a set of ray origins.
struct CertainSpheres {
    Vec3v<float> place;   ///< as stored in lists: the origin relative to the centre, or the centre
    Vec3v<float> origin;  ///< the centre of the origins relative to the sphere's centre
    vreal<float> radius;
    vreal<float> radius2;
    vreal<float> center_error;
};

/// Appends the spheres of `kept` to a list; does not change the count.
inline void append_certain(SphereFilters& list, std::uint32_t kept, const CertainSpheres& spheres,
                           const Origins& origins)
{
    const vreal<float>& error = spheres.center_error;
    const vreal<float> length =
        (sqrt(dot(spheres.origin, spheres.origin)) + vreal<float>(origins.radius)) *
            vreal<float>(inflation) +
        error;
    compress_store(list.x + list.count, kept, spheres.place.x);
    compress_store(list.y + list.count, kept, spheres.place.y);
    compress_store(list.z + list.count, kept, spheres.place.z);
    compress_store(list.radius2 + list.count, kept, spheres.radius2);
    append_bounds(list, kept, sphere_bounds(spheres.radius, error, moment_error(error, length)));
}

/// A shared origin relative to a packet of centres, computed in double and rounded once.
inline Vec3v<float> origin_from_centers(const Origins& origins,
                                        const abi::SphereListView<double>& wide, int first)
{
    const auto from = [&](int axis, const double* center) {
        const vreal<double> origin(double{origins.center[axis]});
        return narrow(origin - load(center + first), origin - load(center + first + lanes<double>));
    };
    return {from(0, wide.center_x), from(1, wide.center_y), from(2, wide.center_z)};
}

/// Fills a list with the spheres that a cone may hit; with all if the cone is not bounded.
template <Origin O>
inline void find_certain(SphereFilters& list, const Origins& origins, const Cone<float>& cone,
                         const abi::SphereListView<float>& spheres,
                         const abi::SphereListView<double>& wide)
{
    list.count = 0;
    list.sorted = false;
    for_each_met(cone, spheres, [&](int first, std::uint32_t kept, const Vec3v<float>& center) {
        const Vec3v<float> w = O == Origin::shared ? origin_from_centers(origins, wide, first)
                                                   : broadcast(origins.center) - center;
        const vreal<float> error =
            O == Origin::shared ? vreal<float>(0.0f) : load(spheres.center_error + first);
        compress_store(list.surface + list.count, kept, load(spheres.surface + first));
        append_certain(list, kept,
                       {O == Origin::shared ? w : center, w, load(spheres.radius + first),
                        load(spheres.radius2 + first), error},
                       origins);
        list.count += __builtin_popcount(kept);
    });
}

/// The rays' origins relative to the centre of one sphere of a list.
template <Origin O>
inline Vec3v<float> origin_from(const SphereFilters& list, int i, const RayPacket<float>& rays)
{
    const Vec3v<float> place{vreal<float>(list.x[i]), vreal<float>(list.y[i]),
                             vreal<float>(list.z[i])};
    return O == Origin::shared ? place : rays.org - place;
}

inline SphereTest test_of(const SphereFilters& list, int i, const Vec3v<float>& w)
{
    return {w,
            vreal<float>(list.radius2[i]),
            {vreal<float>(list.bounds.outer2[i]), vreal<float>(list.bounds.inner2[i]),
             vreal<float>(list.bounds.along[i]), vreal<float>(list.bounds.moment[i]),
             vreal<float>(list.bounds.size[i]), vreal<float>(list.bounds.band2[i]),
             vreal<float>(list.bounds.reach[i])}};
}

inline ListedSphere<SphereFilters> object_at(const SphereFilters& list, int index)
{
    return {list, index};
}

template <Origin O, class Own>
inline void keep_certain(HitPacket<float>& hit, const ListedSphere<SphereFilters>& sphere,
                         const RayPacket<float>& rays, const RayScale& scale, const Own& own)
{
    const auto& [list, i] = sphere;
    const Vec3v<float> w = origin_from<O>(list, i, rays);
    const SphereApproach near = approach(w, vreal<float>(list.bounds.outer2[i]), rays);
    if (near.near != 0)
        keep_sphere(hit, test_of(list, i, w), near, rays, scale, list.surface[i], own);
}

template <Origin O, class Own>
inline Occlusion occludes(const ListedSphere<SphereFilters>& sphere, const RayPacket<float>& rays,
                          const RayScale& scale, const vreal<float>& t_end, const Own&)
{
    const auto& [list, i] = sphere;
    const Vec3v<float> w = origin_from<O>(list, i, rays);
    const SphereApproach near = approach(w, vreal<float>(list.bounds.outer2[i]), rays);
    if (near.near == 0)
        return {};
    return occludes(test_of(list, i, w), near, rays, scale, t_end);
}

/// Divides one block into the `arrays`, of `length` elements each. They become null if the arena
/// only measures.
template <class Real, class Arena, std::size_t Count>
inline void share_block(Arena& arena, Real** const (&arrays)[Count], std::size_t length)
{
    Real* const block = arena.template take<Real>(Count * length);
    for (std::size_t i = 0; i < Count; ++i)
        *arrays[i] = block == nullptr ? nullptr : block + i * length;
}

/// The length of an array for `count` spheres, including the padding for whole packets.
inline std::size_t padded_length(int count)
{
    return (static_cast<std::size_t>(count) / abi::padding + 2) * abi::padding;
}

/// Takes memory for `count` spheres; `arena.take<T>(count)` returns memory for `count` of T.
template <class Arena, class Real>
inline void take_memory(Arena& arena, SharedOriginSpheres<Real>& list, int count)
{
    Real** const arrays[] = {&list.x, &list.y, &list.z, &list.radius2, &list.constant};
    share_block(arena, arrays, padded_length(count));
    list.surface = arena.template take<lane_int<Real>>(padded_length(count));
}
template <class Arena, class Real>
inline void take_memory(Arena& arena, SelectedSpheres<Real>& list, int count)
{
    take_memory(arena, list.copies, count);
}

/// All arrays of a list except `surface`.
struct FilterArrays {
    float** of[12];
};
inline FilterArrays arrays_of(SphereFilters& list)
{
    SphereBounds<float*>& bounds = list.bounds;
    return {{&list.x, &list.y, &list.z, &list.radius2, &bounds.outer2, &bounds.inner2,
             &bounds.along, &bounds.moment, &bounds.size, &bounds.band2, &bounds.reach,
             &list.distance}};
}

template <class Arena>
inline void take_memory(Arena& arena, SphereFilters& list, int count)
{
    share_block(arena, arrays_of(list).of, padded_length(count));
    list.surface = arena.template take<std::int32_t>(padded_length(count));
}

/// The kind, see kinds.hpp.
struct Sphere : KindOf<abi::Primitive::sphere, abi::SurfaceKind::sphere> {
    template <class Real>
    using FromPoint = SharedOriginSpheres<Real>;
    template <class Real>
    using Selected = SelectedSpheres<Real>;
    using Certain = SphereFilters;

    template <class Real>
    static const auto& list(const abi::GeometryView<Real>& scene)
    {
        return scene.spheres;
    }
    static const auto* shapes(const abi::ShapesView& shapes)
    {
        return shapes.spheres;
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
