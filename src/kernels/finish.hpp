#pragma once

#include "kernels/records.hpp"
#include "kernels/stiff.hpp"
#include "kernels/surface.hpp"
#include "kernels/surface_form.hpp"

// Hits of rays in single precision, solved again in double: the search says which surface a ray
// meets, this where exactly, once a ray.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Half a packet of hits.
struct HalfHit {
    vreal<double> t;
    Vec3v<double> gradient;  ///< outwards, any length
};

/// The root nearest to `t`.
inline vreal<double> nearest_root(const Quadratic<double>& quadratic, const vreal<double>& t)
{
    // A hit grazes where double has no root.
    const vreal<double> root = sqrt(max(quadratic.discriminant, vreal<double>(0.0)));
    const vreal<double> minus_q = quadratic.b + with_sign_of(root, quadratic.b);
    const vreal<double> first = negated(quadratic.c) / minus_q;
    const vreal<double> second = negated(minus_q) / quadratic.a;
    const auto second_is_nearer = abs(second - t) < abs(first - t);
    const auto first_is_none = !(abs(first - t) <= abs(first - t));
    return select(either(second_is_nearer, first_is_none), second, first);
}

inline Vec3v<double> at(const RayPacket<double>& rays, const vreal<double>& t)
{
    return madd<double>(t, rays.dir, rays.org);
}

inline HalfHit finish(const abi::StiffSphere& sphere, const RayPacket<double>& rays,
                      const vreal<double>& t)
{
    const vreal<double> exact = nearest_root(quadratic_of(sphere, rays), t);
    return {exact, at(rays, exact) - broadcast(sphere.center)};
}

inline HalfHit finish(const abi::HugeSphere<double>& sphere, const RayPacket<double>& rays,
                      const vreal<double>& t)
{
    const vreal<double> exact = nearest_root(quadratic_of(sphere, rays), t);
    const Vec3v<double> p = at(rays, exact) - broadcast(sphere.anchor);
    return {exact, madd<double>(vreal<double>(sphere.curvature), p, broadcast(sphere.normal))};
}

inline HalfHit finish(const abi::PlaneRecord<double>& plane, const RayPacket<double>& rays,
                      const vreal<double>&)
{
    return {plane_t(plane, rays), broadcast(plane.normal)};
}

/// A covector of canonical space in the world.
inline Vec3v<double> apply_transposed(const abi::QuadricRecord<double>& quadric,
                                      const Vec3v<double>& g)
{
    return madd<double>(g.x, broadcast(quadric.inverse[0]),
                        madd<double>(g.y, broadcast(quadric.inverse[1]),
                                     scale<double>(g.z, broadcast(quadric.inverse[2]))));
}

inline HalfHit finish_side(const abi::QuadricRecord<double>& quadric, const RayPacket<double>& rays,
                           const vreal<double>& t)
{
    const Vec3v<double> p = quadric_origin<double>(quadric, rays.org).p;
    const Vec3v<double> v = apply_inverse(quadric, rays.dir);
    const auto [quadratic, start] = near_quadratic<double>(quadric, p, v);
    const vreal<double> exact = start + nearest_root(quadratic, t - start);
    Vec3v<double> g = broadcast(quadric.square) * madd<double>(exact, v, p);
    g.z = g.z + vreal<double>(quadric.linear);
    return {exact, apply_transposed(quadric, g)};
}

/// `side` is -1 for the low cap and 1 for the high one.
inline HalfHit finish_cap(const abi::QuadricRecord<double>& quadric, const RayPacket<double>& rays,
                          double side)
{
    const vreal<double> height = quadric_origin<double>(quadric, rays.org).height;
    const vreal<double> bound(side < 0 ? quadric.clip_low : quadric.clip_high);
    const Vec3v<double> clip = broadcast(quadric.clip);
    return {(bound - height) / dot(clip, rays.dir), scale<double>(vreal<double>(side), clip)};
}

inline HalfHit finish(const abi::StiffObject& object, int piece, const RayPacket<double>& rays,
                      const vreal<double>& t)
{
    switch (object.kind) {
        case abi::StiffKind::sphere:
            return finish(object.sphere, rays, t);
        case abi::StiffKind::huge_sphere:
            return finish(object.huge, rays, t);
        case abi::StiffKind::plane:
            return finish(object.plane, rays, t);
        case abi::StiffKind::quadric:
            break;
    }
    return piece == 0 ? finish_side(object.quadric, rays, t)
                      : finish_cap(object.quadric, rays, piece == 1 ? -1.0 : 1.0);
}

/// A packet of hits with all that shading needs of the place.
template <class Real>
struct FinishedHits {
    vreal<Real> t;
    Vec3v<Real> point;
    Vec3v<Real> gradient;  ///< outwards and unit; not set where the scene has none solved again
};

/// Solves the lanes of `same` again, all on one surface, which `solve(rays, t)` knows.
template <class Solve>
inline void finish_surface(FinishedHits<float>& hits, const RayPacket<double>& low,
                           const RayPacket<double>& high, const vmask<float>& same,
                           const Solve& solve)
{
    const HalfHit a = solve(low, low_half(hits.t));
    const HalfHit b = solve(high, high_half(hits.t));
    const vreal<float> t = joined(a.t, b.t);
    // Where the search and double disagree of a root's being there, the search's t stays.
    const auto use = same & (abs(t - hits.t) <= abs(hits.t) * vreal<float>(0.01f));
    hits.t = select(use, t, hits.t);
    hits.point = select(use, joined(at(low, a.t), at(high, b.t)), hits.point);
    hits.gradient =
        select(same, joined(unit<double>(a.gradient), unit<double>(b.gradient)), hits.gradient);
}

inline abi::StiffSphere stiff_sphere(const abi::SphereShape& sphere)
{
    return {{sphere.center[0], sphere.center[1], sphere.center[2]}, sphere.radius * sphere.radius};
}

/// One step of Newton's method for the lanes of `same`: what cancels, the equation's value at
/// the hit, is computed in double. It squares the error, which single precision left small.
inline void sharpen_surface(FinishedHits<float>& hits, const abi::SurfaceForm& form,
                            const RayPacket<double>& low, const RayPacket<double>& high,
                            const vmask<float>& same)
{
    const FormAlong<double> a = along(form, at(low, low_half(hits.t)), low.dir);
    const FormAlong<double> b = along(form, at(high, high_half(hits.t)), high.dir);
    const vreal<float> slope = joined(a.slope, b.slope);
    const vreal<float> step = joined(a.constant, b.constant) / (slope + slope);
    const Vec3v<float> point = joined(at(low, low_half(hits.t) - low_half(step)),
                                      at(high, high_half(hits.t) - high_half(step)));
    const auto use = same & (abs(step) <= abs(hits.t) * vreal<float>(0.0625f));
    if (form.sharpened == abi::Sharpened::all)
        hits.t = select(use, hits.t - step, hits.t);
    hits.point = select(use, point, hits.point);
}

/// Sharpens all hits of `active` on surfaces that ask for it.
[[gnu::noinline]] inline void sharpen_hits(FinishedHits<float>& hits,
                                           const abi::SceneView<float>& scene,
                                           const RayPacket<float>& rays, const vint<float>& surface,
                                           std::uint32_t active)
{
    const RayPacket<double> low = low_half(rays);
    const RayPacket<double> high = high_half(rays);
    for_each_distinct<float>(surface, active, [&](std::int32_t number, const vmask<float>& same) {
        with_form(scene, number, [&](const abi::SurfaceForm& form) {
            if (form.sharpened != abi::Sharpened::nothing)
                sharpen_surface(hits, form, low, high, same);
        });
    });
}

/// Solves all hits of `active` again whose surface has a record for it.
[[gnu::noinline]] inline void finish_hits(FinishedHits<float>& hits,
                                          const abi::SceneView<float>& scene,
                                          const RayPacket<float>& rays, const vint<float>& surface,
                                          std::uint32_t active)
{
    const RayPacket<double> low = low_half(rays);
    const RayPacket<double> high = high_half(rays);
    using Half = RayPacket<double>;
    for_each_distinct<float>(surface, active, [&](std::int32_t number, const vmask<float>& same) {
        const abi::SurfacePlace place = scene.places[number];
        const abi::SurfacePlace index = place & abi::place_mask;
        if (!abi::is_other_shape(place)) {
            if ((place & abi::finished_bit) == 0)
                return;
            const abi::StiffSphere sphere = stiff_sphere(scene.sphere_shapes[index]);
            finish_surface(hits, low, high, same, [&](const Half& half, const vreal<double>& t) {
                return finish(sphere, half, t);
            });
        } else if (scene.finish_index[index] >= 0) {
            const abi::StiffObject& object = scene.finish[scene.finish_index[index]];
            const int piece = number - object.surface;
            finish_surface(hits, low, high, same, [&](const Half& half, const vreal<double>& t) {
                return finish(object, piece, half, t);
            });
        }
    });
}

/// The hits of `active`, solved again where the scene says so.
template <abi::Features F, class Real>
inline FinishedHits<Real> finished(const abi::SceneView<Real>& scene, const RayPacket<Real>& rays,
                                   const vreal<Real>& t, const vint<Real>& surface,
                                   std::uint32_t active)
{
    FinishedHits<Real> hits;
    hits.t = t;
    hits.point = madd<Real>(t, rays.dir, rays.org);
    if constexpr (sizeof(Real) == sizeof(float)) {
        if (scene.sharpened)
            sharpen_hits(hits, scene, rays, surface, active);
        if (scene.finish != nullptr) {
            hits.gradient = unit<Real>(gradient_at<F>(scene, hits.point, surface, active).gradient);
            finish_hits(hits, scene, rays, surface, active);
        }
    }
    return hits;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
