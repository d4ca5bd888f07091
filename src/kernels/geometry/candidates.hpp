#pragma once

#include "kernels/geometry/cone.hpp"
#include "kernels/geometry/sphere.hpp"

// The spheres of the scene that a cone may meet, one list a cone.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Spheres for rays that share their origin: `x, y, z` is that origin relative to the centre,
/// `constant` what sphere_constant gives there. In rising order.
template <class Real>
struct SharedOriginSpheres {
    Real* x = nullptr;
    Real* y = nullptr;
    Real* z = nullptr;
    Real* radius2 = nullptr;
    Real* constant = nullptr;
    lane_int<Real>* surface = nullptr;
    int count = 0;
};

template <class Real>
inline Quadratic<Real> quadratic_of(const SharedOriginSpheres<Real>& list, int index,
                                    const RayPacket<Real>& rays)
{
    const Vec3v<Real> o{vreal<Real>(list.x[index]), vreal<Real>(list.y[index]),
                        vreal<Real>(list.z[index])};
    return sphere_quadratic<Real>(rays, o, vreal<Real>(list.radius2[index]),
                                  vreal<Real>(list.constant[index]));
}

/// Calls `visit(first, kept, center)` for the packets of spheres that hold any which a ray of the
/// cone may meet: those of the lanes `kept`.
template <class Real, class Visit>
inline void for_each_met(const Cone<Real>& cone, const abi::SphereListView<Real>& spheres,
                         const Visit& visit)
{
    const Vec3v<Real> base = broadcast(cone.base);
    for (int first = 0; first < spheres.count; first += lanes<Real>) {
        const Vec3v<Real> center{load(spheres.center_x + first), load(spheres.center_y + first),
                                 load(spheres.center_z + first)};
        std::uint32_t kept = first_lanes<Real>(spheres.count - first);
        if (cone.bounded)
            kept &= bits(may_meet<Real>(cone, center - base, load(spheres.radius + first)));
        if (kept != 0)
            visit(first, kept, center);
    }
}

template <class Real>
inline void append_sphere(SharedOriginSpheres<Real>& list, const abi::SphereListView<Real>& spheres,
                          int first, std::uint32_t kept, const Vec3v<Real>& place)
{
    compress_store(list.x + list.count, kept, place.x);
    compress_store(list.y + list.count, kept, place.y);
    compress_store(list.z + list.count, kept, place.z);
    compress_store(list.radius2 + list.count, kept, load(spheres.radius2 + first));
    compress_store(list.surface + list.count, kept, load(spheres.surface + first));
    list.count += __builtin_popcount(kept);
}

/// Fills `list` with the spheres that rays from `cone.base` may meet. What is kept of a sphere
/// has the same bits as what the test of a single packet computes.
template <class Real>
inline void find_candidates(SharedOriginSpheres<Real>& list, const Cone<Real>& cone,
                            const abi::SphereListView<Real>& spheres)
{
    const Vec3v<Real> base = broadcast(cone.base);
    list.count = 0;
    for_each_met(cone, spheres, [&](int first, std::uint32_t kept, const Vec3v<Real>& center) {
        const Vec3v<Real> o = base - center;
        compress_store(list.constant + list.count, kept,
                       sphere_constant<Real>(o, load(spheres.radius2 + first)));
        append_sphere(list, spheres, first, kept, o);
    });
}

/// The spheres that parallel rays from several points may meet, in the room of a list for rays that
/// share their origin: centres in place of origins.
template <class Real>
inline void find_parallel_candidates(SharedOriginSpheres<Real>& list, const Cone<Real>& cone,
                                     const abi::SphereListView<Real>& spheres)
{
    list.count = 0;
    for_each_met(cone, spheres, [&](int first, std::uint32_t kept, const Vec3v<Real>& center) {
        append_sphere(list, spheres, first, kept, center);
    });
}

/// A list that find_parallel_candidates() filled.
template <class Real>
inline abi::SphereListView<Real> parallel_candidates(const SharedOriginSpheres<Real>& list)
{
    return {list.x, list.y, list.z, nullptr, list.radius2, nullptr, list.surface, list.count};
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
