#pragma once

#include "kernel_abi/scene_view.hpp"
#include "kernels/geometry/anchored_sphere.hpp"
#include "kernels/geometry/quadric.hpp"

// Half the gradient of each kind of surface at a point, by its record in double: for packets of
// either precision.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
inline Vec3v<Real> broadcast_as(const double (&v)[3])
{
    return {vreal<Real>(static_cast<Real>(v[0])), vreal<Real>(static_cast<Real>(v[1])),
            vreal<Real>(static_cast<Real>(v[2]))};
}

/// Unit; where the gradient vanishes, as in a cone's apex or where planes cross, the way against
/// the ray.
template <class Real>
inline Vec3v<Real> unit_or_against(const Vec3v<Real>& gradient, const Vec3v<Real>& dir)
{
    const vreal<Real> zero(Real(0));
    const vreal<Real> one(Real(1));
    const auto vanishes = !(dot(gradient, gradient) > zero);
    const Vec3v<Real> against{negated(dir.x), negated(dir.y), negated(dir.z)};
    const Vec3v<Real> any = select(vanishes, against, gradient);
    return scale<Real>(one / sqrt(dot(any, any)), any);
}

/// Of length 1 on the surface.
template <class Real>
inline Vec3v<Real> normal_at(const abi::SphereShape& sphere, const Vec3v<Real>& point)
{
    return scale<Real>(vreal<Real>(static_cast<Real>(1.0 / sphere.radius)),
                       point - broadcast_as<Real>(sphere.center));
}

/// Likewise.
template <class Real>
inline Vec3v<Real> normal_at(const abi::AnchoredSphere<double>& sphere, const Vec3v<Real>& point)
{
    return madd<Real>(vreal<Real>(static_cast<Real>(sphere.curvature)),
                      point - broadcast_as<Real>(sphere.anchor), broadcast_as<Real>(sphere.normal));
}

/// A covector of canonical space in the world.
template <class Real>
inline Vec3v<Real> apply_transposed(const abi::QuadricRecord<double>& quadric, const Vec3v<Real>& g)
{
    return madd<Real>(g.x, broadcast_as<Real>(quadric.inverse[0]),
                      madd<Real>(g.y, broadcast_as<Real>(quadric.inverse[1]),
                                 scale<Real>(g.z, broadcast_as<Real>(quadric.inverse[2]))));
}

/// Whether a quadric is two planes that cross: s_i x_i² + s_j x_j² = 0.
inline bool crossing_planes(const abi::QuadricRecord<double>& quadric)
{
    const double(&s)[3] = quadric.square;
    const int flat = (s[0] == 0) + (s[1] == 0) + (s[2] == 0);
    return quadric.constant == 0 && quadric.linear == 0 && flat == 1;
}

/// The gradient of two planes that cross is that of one of them, and of no other direction however
/// near to their edge: |s_i| x_i² = |s_j| x_j² there.
template <class Real>
inline Vec3v<Real> plane_gradient(const abi::QuadricRecord<double>& quadric, const Vec3v<Real>& p)
{
    const auto component = [](double s, const vreal<Real>& x) {
        const vreal<Real> size(static_cast<Real>(__builtin_sqrt(s < 0 ? -s : s)));
        const vreal<Real> g = with_sign_of(size, s < 0 ? negated(x) : x);
        return select(x == vreal<Real>(Real(0)), x, g);
    };
    return apply_transposed<Real>(
        quadric, {component(quadric.square[0], p.x), component(quadric.square[1], p.y),
                  component(quadric.square[2], p.z)});
}

/// Of the side, at a point given in canonical space.
template <class Real>
inline Vec3v<Real> side_gradient(const abi::QuadricRecord<double>& quadric, const Vec3v<Real>& p)
{
    if (crossing_planes(quadric))
        return plane_gradient<Real>(quadric, p);
    Vec3v<Real> g = broadcast_as<Real>(quadric.square) * p;
    g.z = g.z + vreal<Real>(static_cast<Real>(quadric.linear));
    return apply_transposed<Real>(quadric, g);
}

/// The same at a point of the world.
template <class Real>
inline Vec3v<Real> side_gradient_at(const abi::QuadricRecord<double>& quadric,
                                    const Vec3v<Real>& point)
{
    const Vec3v<Real> w =
        (point - broadcast_as<Real>(quadric.center)) - broadcast_as<Real>(quadric.center_low);
    const Vec3v<Real> p{dot(broadcast_as<Real>(quadric.inverse[0]), w),
                        dot(broadcast_as<Real>(quadric.inverse[1]), w),
                        dot(broadcast_as<Real>(quadric.inverse[2]), w)};
    return side_gradient<Real>(quadric, p);
}

template <class Real>
inline Vec3v<Real> cap_gradient(const abi::QuadricRecord<double>& quadric, bool high)
{
    const vreal<Real> sign(high ? Real(1) : Real(-1));
    return scale<Real>(sign, broadcast_as<Real>(quadric.clip));
}

/// The outward unit normal of one surface at a point, for rays of direction `dir`.
template <class Real>
inline Vec3v<Real> surface_normal(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                                  const Vec3v<Real>& point, const Vec3v<Real>& dir)
{
    switch (index.kind) {
        case abi::SurfaceKind::sphere:
            return unit_or_against<Real>(normal_at<Real>(shapes.spheres[index.record], point), dir);
        case abi::SurfaceKind::anchored_sphere:
            return unit_or_against<Real>(
                normal_at<Real>(shapes.anchored_spheres[index.record], point), dir);
        case abi::SurfaceKind::plane:
            return broadcast_as<Real>(shapes.planes[index.record].normal);
        case abi::SurfaceKind::quadric_side:
            return unit_or_against<Real>(
                side_gradient_at<Real>(shapes.quadrics[index.record], point), dir);
        case abi::SurfaceKind::low_cap:
        case abi::SurfaceKind::high_cap:
            return unit_or_against<Real>(
                cap_gradient<Real>(shapes.quadrics[index.record],
                                   index.kind == abi::SurfaceKind::high_cap),
                dir);
        case abi::SurfaceKind::none:
            break;
    }
    return unit_or_against<Real>(dir, dir);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
