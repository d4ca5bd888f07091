#pragma once

#include "kernel_abi/features.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/observation.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernels/geometry/object_list.hpp"
#include "kernels/geometry/one_surface.hpp"

// Spheres: the test, also for rays from one point, and the point of a hit.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// o|² - r², where o is the ray origin relative to the centre.
template <class Real>
inline vreal<Real> sphere_constant(const Vec3v<Real>& o, const vreal<Real>& radius2)
{
    return dot(o, o) - radius2;
}

/// The quadratic of a ray and |P|² = r²; `o` is the ray's origin relative to the centre. The
/// discriminant is Lagrange's form a r² - |o × d|², which does not cancel for distant spheres as b²
/// - a c does.
template <class Real>
inline Quadratic<Real> sphere_quadratic(const RayPacket<Real>& rays, const Vec3v<Real>& o,
                                        const vreal<Real>& radius2, const vreal<Real>& constant)
{
    const Vec3v<Real> moment = cross(o, rays.dir);
    Quadratic<Real> q;
    q.a = rays.dir2;
    q.b = dot(o, rays.dir);
    q.c = constant;
    q.discriminant = msub(rays.dir2, radius2, dot(moment, moment));
    return q;
}

/// The sphere at `index` of a list.
template <class Real>
inline Quadratic<Real> quadratic_of(const abi::SphereListView<Real>& list, int index,
                                    const RayPacket<Real>& rays)
{
    const Vec3v<Real> center{vreal<Real>(list.center_x[index]), vreal<Real>(list.center_y[index]),
                             vreal<Real>(list.center_z[index])};
    const Vec3v<Real> o = rays.org - center;
    const vreal<Real> radius2(list.radius2[index]);
    return sphere_quadratic<Real>(rays, o, radius2, sphere_constant<Real>(o, radius2));
}

/// x |x|, which makes every ray miss a sphere of negative radius.
template <class Real>
inline batch<Real> signed_square(batch<Real> x)
{
    return x * abs(x);
}

/// Spheres for rays that share their origin, in order of surface numbers: `x, y, z` is that origin
/// relative to the centre, `constant` the value of sphere_constant() there.
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

/// Calls `visit(first, kept, center)` for the packets of spheres in which rays of the cone may hit
/// the lanes `kept`.
template <class Real, class Visit>
inline void for_each_met(const Cone<Real>& cone, const abi::SphereListView<Real>& spheres,
                         const Visit& visit)
{
    const Vec3v<Real> base = broadcast(cone.base);
    for (int first = 0; first < spheres.count; first += lanes<Real>) {
        const Vec3v<Real> center{load(spheres.center_x + first), load(spheres.center_y + first),
                                 load(spheres.center_z + first)};
        std::uint32_t kept = first_lanes<Real>(spheres.count - first);
        // Rounding may have moved the centre of a small, distant sphere out of the cone.
        if (cone.bounded)
            kept &= bits(
                may_meet<Real>(cone, center - base,
                               load(spheres.radius + first) + load(spheres.center_error + first)));
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

/// Fills `list` with the spheres that rays from `cone.base` may hit. The stored values have the
/// same bits as those that the test of a single packet computes.
template <class Real>
inline void find_from_point(SharedOriginSpheres<Real>& list, const Cone<Real>& cone,
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

/// Some spheres of a scene: either all, or copies. The copies use the arrays of a list for rays
/// that share their origin, with centres instead of origins.
template <class Real>
struct SelectedSpheres : abi::SphereListView<Real> {
    SharedOriginSpheres<Real> copies;
};

/// Fills `list` with the spheres that rays of `cone` may hit.
template <class Real>
inline void find_met(SelectedSpheres<Real>& list, const Cone<Real>& cone,
                     const abi::SphereListView<Real>& spheres)
{
    abi::SphereListView<Real>& view = list;
    if (!cone.bounded) {
        view = spheres;
        return;
    }
    SharedOriginSpheres<Real>& copies = list.copies;
    copies.count = 0;
    for_each_met(cone, spheres, [&](int first, std::uint32_t kept, const Vec3v<Real>& center) {
        append_sphere(copies, spheres, first, kept, center);
    });
    view = {copies.x,       copies.y, copies.z,       nullptr,
            copies.radius2, nullptr,  copies.surface, copies.count};
}

/// One sphere of a list of any type.
template <class List>
struct ListedSphere {
    const List& list;
    int index;
};
template <class Real>
inline ListedSphere<abi::SphereListView<Real>> object_at(const abi::SphereListView<Real>& list,
                                                         int index)
{
    return {list, index};
}
template <class Real>
inline ListedSphere<SharedOriginSpheres<Real>> object_at(const SharedOriginSpheres<Real>& list,
                                                         int index)
{
    return {list, index};
}

template <class List>
inline Body body_of(const ListedSphere<List>& sphere)
{
    return {static_cast<std::int32_t>(sphere.list.surface[sphere.index])};
}

template <class List, class Real>
inline Quadratic<Real> quadratic_of(const ListedSphere<List>& sphere, const RayPacket<Real>& rays)
{
    return quadratic_of(sphere.list, sphere.index, rays);
}

/// The outward normal, of length 1 for points on the surface.
template <class Real>
inline Vec3v<Real> normal_at(const abi::SphereShape& sphere, const Vec3v<Real>& point)
{
    return scale<Real>(vreal<Real>(static_cast<Real>(1.0 / sphere.radius)),
                       point - broadcast_as<Real>(sphere.center));
}

template <class Real>
inline Vec3v<Real> unit_normal(const abi::SphereShape& sphere, unsigned, const Vec3v<Real>& point,
                               const Vec3v<Real>& dir)
{
    return unit_or_against<Real>(normal_at<Real>(sphere, point), dir);
}

inline vreal<double> height_over(const abi::SphereShape& sphere, unsigned,
                                 const Vec3v<double>& point)
{
    const Vec3v<double> w = point - broadcast(sphere.center);
    return sqrt(dot(w, w)) - vreal<double>(sphere.radius);
}

inline RefinedHalf refine(const abi::SphereShape& sphere, unsigned, const RayPacket<double>& rays)
{
    const vreal<double> radius2(sphere.radius * sphere.radius);
    const Vec3v<double> o = rays.org - broadcast(sphere.center);
    RefinedHalf hit;
    hit.t =
        first_root(sphere_quadratic<double>(rays, o, radius2, sphere_constant<double>(o, radius2)),
                   rays.t_min);
    hit.point = point_at(rays, hit.t);
    // From afar the point's error in double is larger than a normal's length may be off, so the
    // normal is scaled to length 1.
    hit.normal = unit_normal<double>(sphere, 0, hit.point, rays.dir);
    return hit;
}

/// The equation of spheres, one per lane or one for all lanes: |w|² = radius² for w from the
/// centre.
struct SphereForm {
    static constexpr bool root_is_known = false;

    BothHalves<Vec3v<double>> base;
    BothHalves<vreal<double>> radius2;
    Vec3v<float> rough_base;
    vreal<float> rough_radius;
};

inline SphereForm form_of(const abi::SphereShape& sphere)
{
    const Vec3v<double> center = broadcast(sphere.center);
    const vreal<double> radius2(sphere.radius * sphere.radius);
    return {{center, center}, {radius2, radius2}, rough(sphere.center), rough(sphere.radius)};
}

/// One sphere per lane; lanes that are not set hold a sphere of radius 1 around the origin.
class SphereLanes {
public:
    void put(std::uint32_t lanes_of, const abi::SphereShape& sphere)
    {
        const vmask<double> low = from_bits<double>(lanes_of & all_lanes<double>);
        const vmask<double> high = from_bits<double>(lanes_of >> lanes<double>);
        const Vec3v<double> center = broadcast(sphere.center);
        const vreal<double> radius(sphere.radius);
        center_ = {select(low, center, center_.low), select(high, center, center_.high)};
        radius_ = {select(low, radius, radius_.low), select(high, radius, radius_.high)};
    }

    [[nodiscard]] SphereForm form() const
    {
        return {center_,
                {radius_.low * radius_.low, radius_.high * radius_.high},
                narrow(center_.low, center_.high),
                narrow(radius_.low, radius_.high)};
    }

private:
    const vreal<double> none_ = vreal<double>(0.0);
    BothHalves<Vec3v<double>> center_ = {{none_, none_, none_}, {none_, none_, none_}};
    BothHalves<vreal<double>> radius_ = {vreal<double>(1.0), vreal<double>(1.0)};
};

inline RoughRoot rough_root(const SphereForm& form, const RayPacket<float>& rays)
{
    const Vec3v<float> w = rays.org - form.rough_base;
    const Vec3v<float> moment = cross(w, rays.dir);
    const vreal<float> across = rays.dir2 * (form.rough_radius * form.rough_radius);
    const vreal<float> root = sqrt(max(across - dot(moment, moment), vreal<float>(0.0f)));
    const vreal<float> b = dot(w, rays.dir);
    const vreal<float> inverse = vreal<float>(1.0f) / rays.dir2;
    const vreal<float> near = negated(b + root) * inverse;
    const auto counts = near > rays.t_min;
    // Gradients of smaller spheres lose digits to underflow. NaN makes the Newton step fail.
    const auto small = form.rough_radius < vreal<float>(1e-30f);
    const vreal<float> t = select(counts, near, (root - b) * inverse);
    return {select(small, vreal<float>(__builtin_nanf("")), t), rays.dir2};
}

inline Residual residual(const SphereForm& form, const WideRays& rays, const vreal<float>& t)
{
    const Vec3v<double> low = from_base(rays.org.low, rays.dir.low, widen_low(t), form.base.low);
    const Vec3v<double> high =
        from_base(rays.org.high, rays.dir.high, widen_high(t), form.base.high);
    return {narrow(dot(low, low) - form.radius2.low, dot(high, high) - form.radius2.high),
            narrow(dot(low, rays.dir.low), dot(high, rays.dir.high)), narrow(low, high)};
}

/// The unit normal at a `step` from the point of the gradient.
inline Vec3v<float> normal_of(const SphereForm& form, const Vec3v<float>& gradient,
                              const Vec3v<float>& step)
{
    return scale<float>(vreal<float>(1.0f) / form.rough_radius, gradient + step);
}

inline HitAgain hit_again(const abi::SphereShape&, unsigned)
{
    return HitAgain::from_inside;
}

/// Where rays from points on the surface hit it again beyond t_min. `outside` are the lanes that
/// leave on the outer side.
inline OwnCrossing second_crossing(const abi::SphereShape& sphere, unsigned,
                                   const Vec3v<double>& point, const Vec3v<double>& dir,
                                   const vreal<double>& t_min, vmask<double> outside)
{
    return only_crossing({dot(point - broadcast(sphere.center), dir), dot(dir, dir)}, t_min,
                         outside);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
