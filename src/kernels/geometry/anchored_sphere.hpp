#pragma once

#include "kernel_abi/features.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/observation.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernels/geometry/cone.hpp"
#include "kernels/geometry/object_list.hpp"
#include "kernels/geometry/one_surface.hpp"

// Spheres seen from near their surface: the test, for rays from one point, too, and a hit's place.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The form of an anchored sphere or plane (docs/numerics_derivations.md) at a place; what their
/// quadratic needs of a ray's origin alone.
template <class Real>
struct AnchoredOrigin {
    Vec3v<Real> g;  ///< half the gradient
    vreal<Real> constant;
};

/// With p the place relative to the anchor, g = n + k p is half the gradient there and
/// (g + n)·p + k0 the form's value: no term is of the size of the radius, which a ground
/// sphere's would drown in.
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

/// The ray against a sphere given by a surface point and its curvature (abi::AnchoredSphere):
/// F(t) = k a t² + 2 (g·d) t + F(0). `curved` is k F(0).
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
    // From afar both terms are large; as |g|² - k F(0) = 1, their difference is a - |g × d|² too.
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

/// An anchored sphere seen from an origin that all rays share.
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

/// Whether rays of `cone` leave a convex surface behind them: they start outside and go the
/// way of its outward gradient.
template <class Real>
inline bool leaves_behind(const Cone<Real>& cone, const SharedOriginAnchored<Real>& sphere)
{
    const Real inwards[3] = {-sphere.g[0], -sphere.g[1], -sphere.g[2]};
    return sphere.constant > 0 && runs_against(cone, inwards);
}

/// Of length 1 on the surface.
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
    // As of a sphere that is not anchored.
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

/// Where rays from points of the surface meet it again beyond t_min. `outside` are the lanes that
/// leave it on the outer side.
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
