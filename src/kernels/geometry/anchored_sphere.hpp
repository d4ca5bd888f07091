#pragma once

#include "kernel_abi/features.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/observation.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernels/geometry/cone.hpp"
#include "kernels/geometry/object_list.hpp"
#include "kernels/geometry/one_surface.hpp"

// Anchored spheres (abi::AnchoredSphere): the test, also for rays from one point, and the point of
// a hit.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The equation of an anchored sphere or plane (docs/numerics_derivations.md) at a point: the part
/// of the quadratic that depends only on the ray's origin.
template <class Real>
struct AnchoredOrigin {
    Vec3v<Real> g;  ///< half the gradient of F
    vreal<Real> constant;
};

/// With p the point relative to the anchor, g = n + k p is half the gradient of F and (g + n)·p +
/// k0 its value. No term is as large as the radius, so the digits of a ground sphere are kept.
template <class Real>
inline AnchoredOrigin<Real> anchored_origin(const Real (&anchor)[3], const Real (&unit_normal)[3],
                                            Real curvature, Real offset, const Vec3v<Real>& place)
{
    const Vec3v<Real> normal = broadcast(unit_normal);
    const Vec3v<Real> p = place - broadcast(anchor);
    const Vec3v<Real> g = madd<Real>(vreal<Real>(curvature), p, normal);
    return {g, dot(g + normal, p) + vreal<Real>(offset)};
}

template <class Real>
inline AnchoredOrigin<Real> anchored_origin(const abi::AnchoredSphere<Real>& sphere,
                                            const Vec3v<Real>& place)
{
    return anchored_origin<Real>(sphere.anchor, sphere.normal, sphere.curvature, sphere.offset,
                                 place);
}

/// The quadratic of a ray and an anchored sphere: F(t) = k a t² + 2 (g·d) t + F(0). `curved` is k
/// F(0).
template <class Real>
inline Quadratic<Real> anchored_quadratic(const AnchoredOrigin<Real>& origin,
                                          const vreal<Real>& curvature, const vreal<Real>& curved,
                                          const RayPacket<Real>& rays)
{
    Quadratic<Real> q;
    q.a = curvature * rays.dir2;
    q.b = dot(origin.g, rays.dir);
    q.c = origin.constant;
    q.discriminant = msub(q.b, q.b, curved * rays.dir2);
    // From afar both terms are large. As |g|² - k F(0) = 1, their difference is also a - |g × d|².
    const auto far = dot(origin.g, origin.g) > vreal<Real>(Real(4));
    if (none(far))
        return q;
    const Vec3v<Real> moment = cross(origin.g, rays.dir);
    q.discriminant = select(far, rays.dir2 - dot(moment, moment), q.discriminant);
    return q;
}

template <class Real>
inline Quadratic<Real> quadratic_of(const abi::AnchoredSphere<Real>& sphere,
                                    const RayPacket<Real>& rays)
{
    const AnchoredOrigin<Real> origin = anchored_origin<Real>(sphere, rays.org);
    const vreal<Real> curvature(sphere.curvature);
    return anchored_quadratic<Real>(origin, curvature, curvature * origin.constant, rays);
}

/// An anchored sphere for rays that share their origin.
template <class Real>
struct SharedOriginAnchored {
    Real g[3];
    Real constant;
    Real curvature;
    Real curved;
    std::int32_t surface;
};

template <class Real>
inline SharedOriginAnchored<Real> share_origin(const abi::AnchoredSphere<Real>& sphere,
                                               const Vec3v<Real>& origin)
{
    const AnchoredOrigin<Real> at = anchored_origin<Real>(sphere, origin);
    return {{first_lane<Real>(at.g.x), first_lane<Real>(at.g.y), first_lane<Real>(at.g.z)},
            first_lane<Real>(at.constant),
            sphere.curvature,
            first_lane<Real>(vreal<Real>(sphere.curvature) * at.constant),
            sphere.surface};
}

template <class Real>
inline Quadratic<Real> quadratic_of(const SharedOriginAnchored<Real>& sphere,
                                    const RayPacket<Real>& rays)
{
    return anchored_quadratic<Real>({broadcast(sphere.g), vreal<Real>(sphere.constant)},
                                    vreal<Real>(sphere.curvature), vreal<Real>(sphere.curved),
                                    rays);
}

/// Whether all rays of `cone` leave a convex surface behind: they start outside and run along its
/// outward gradient.
template <class Real>
inline bool leaves_behind(const Cone<Real>& cone, const SharedOriginAnchored<Real>& sphere)
{
    const Real inwards[3] = {-sphere.g[0], -sphere.g[1], -sphere.g[2]};
    return sphere.constant > 0 && runs_against(cone, inwards);
}

/// The outward normal, of length 1 for points on the surface.
template <class Real>
inline Vec3v<Real> normal_at(const abi::AnchoredSphere<double>& sphere, const Vec3v<Real>& point)
{
    return madd<Real>(vreal<Real>(static_cast<Real>(sphere.curvature)),
                      point - broadcast_as<Real>(sphere.anchor), broadcast_as<Real>(sphere.normal));
}

template <class Real>
inline Vec3v<Real> unit_normal(const abi::AnchoredSphere<double>& sphere, unsigned,
                               const Vec3v<Real>& point, const Vec3v<Real>& dir)
{
    return unit_or_against<Real>(normal_at<Real>(sphere, point), dir);
}

inline vreal<double> height_over(const abi::AnchoredSphere<double>& sphere, unsigned,
                                 const Vec3v<double>& point)
{
    const Vec3v<double> w = point - broadcast(sphere.anchor);
    const vreal<double> value =
        dot(normal_at<double>(sphere, point) + broadcast(sphere.normal), w) +
        vreal<double>(sphere.offset);
    return vreal<double>(0.5) * value;
}

inline RefinedHalf refine(const abi::AnchoredSphere<double>& sphere, unsigned,
                          const RayPacket<double>& rays)
{
    RefinedHalf hit;
    hit.t = first_root(quadratic_of(sphere, rays), rays.t_min);
    hit.point = point_at(rays, hit.t);
    // The same normal as for a sphere that is not anchored.
    hit.normal = unit_normal<double>(sphere, 0, hit.point, rays.dir);
    return hit;
}

inline AnchoredForm form_of(const abi::AnchoredSphere<double>& sphere)
{
    return anchored_form(sphere.anchor, sphere.normal, sphere.curvature, sphere.offset);
}

inline HitAgain hit_again(const abi::AnchoredSphere<double>&, unsigned)
{
    return HitAgain::from_inside;
}

/// Where rays from points on the surface hit it again beyond t_min. `outside` are the lanes that
/// leave on the outer side.
inline OwnCrossing second_crossing(const abi::AnchoredSphere<double>& sphere, unsigned,
                                   const Vec3v<double>& point, const Vec3v<double>& dir,
                                   const vreal<double>& t_min, vmask<double> outside)
{
    return only_crossing({dot(normal_at<double>(sphere, point), dir),
                          vreal<double>(sphere.curvature) * dot(dir, dir)},
                         t_min, outside);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
