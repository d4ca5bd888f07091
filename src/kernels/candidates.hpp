#pragma once

#include "kernels/beam.hpp"
#include "kernels/sphere.hpp"

// The spheres of the scene that a beam may meet, one list a beam.
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

/// Fills `list` with the spheres that rays from `beam.base` may meet. What is kept of a sphere
/// has the same bits as what the test of a single packet computes.
template <class Real>
inline void find_candidates(SharedOriginSpheres<Real>& list, const Beam<Real>& beam,
                            const abi::SphereListView<Real>& spheres)
{
    const Vec3v<Real> base = broadcast(beam.base);
    list.count = 0;
    for (int first = 0; first < spheres.count; first += lanes<Real>) {
        const Vec3v<Real> center{load(spheres.center_x + first), load(spheres.center_y + first),
                                 load(spheres.center_z + first)};
        const Vec3v<Real> o = base - center;
        std::uint32_t kept = first_lanes<Real>(spheres.count - first);
        if (beam.bounded)
            kept &= bits(may_meet<Real>(beam, center - base, load(spheres.radius + first)));
        if (kept == 0)
            continue;
        const vreal<Real> radius2 = load(spheres.radius2 + first);
        compress_store(list.x + list.count, kept, o.x);
        compress_store(list.y + list.count, kept, o.y);
        compress_store(list.z + list.count, kept, o.z);
        compress_store(list.radius2 + list.count, kept, radius2);
        compress_store(list.constant + list.count, kept, sphere_constant<Real>(o, radius2));
        compress_store(list.surface + list.count, kept, load(spheres.surface + first));
        list.count += __builtin_popcount(kept);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
