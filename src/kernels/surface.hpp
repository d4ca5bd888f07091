#pragma once

#include "kernel_abi/features.hpp"
#include "kernel_abi/scene_view.hpp"
#include "kernels/records.hpp"

// What is known of the hit points before any light is looked at.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
struct SurfacePacket {
    Vec3v<Real> point;
    Vec3v<Real> normal;          ///< unit; turned against the ray where the model says so
    Vec3v<Real> dir;             ///< of the ray that came here
    vreal<Real> inverse_length;  ///< 1 / |dir|
    vint<Real> number;
    vint<Real> material;
    vint<Real> object;
    Vec3v<Real> lift;       ///< outwards, to where rounding has no part in which side a point is on
    std::uint32_t leaving;  ///< lanes that come from the inside
};

/// The normal as it stands, not unit, and whether it is turned against the ray.
template <class Real>
struct GradientPacket {
    Vec3v<Real> gradient;
    vreal<Real> faces_viewer;
    Vec3v<Real>
        from_anchor;  ///< the point relative to the surface's centre, or what it has for one
};

/// What a sphere that has a shape of its own would have for a record.
template <class Real>
inline void make_record(const abi::SceneView<Real>& scene, abi::SurfacePlace place,
                        abi::SurfaceRecord<Real>& record)
{
    const abi::SphereShape& sphere = scene.sphere_shapes[place & abi::place_mask];
    for (int axis = 0; axis < 3; ++axis) {
        record.anchor[axis] = static_cast<Real>(sphere.center[axis]);
        record.normal[axis] = 0;
    }
    record.curvature = static_cast<Real>(1.0 / sphere.radius);
    record.faces_viewer = (place & abi::faces_viewer_bit) != 0 ? Real(1) : Real(0);
}

template <class Real>
inline void make_record(const abi::SceneView<Real>& scene, abi::SurfacePlace place,
                        abi::CurvedSurfaceRecord<Real>& record)
{
    abi::SurfaceRecord<Real> sphere;
    make_record(scene, place, sphere);
    for (int axis = 0; axis < 3; ++axis) {
        record.anchor[axis] = sphere.anchor[axis];
        record.normal[axis] = 0;
        record.curvature[axis] = sphere.curvature;
        record.curvature[axis + 3] = 0;
    }
    record.faces_viewer = sphere.faces_viewer;
}

/// The records of lanes' surfaces, from a table or made of spheres' shapes.
template <int Fields, class Record, class Real>
inline RecordPacket<Fields, Real> surface_records(const abi::SceneView<Real>& scene,
                                                  const Record* table, const vint<Real>& surface,
                                                  std::uint32_t active)
{
    return find_records<Fields, Real>(surface, active, [&](lane_int<Real> number) {
        const abi::SurfacePlace place = scene.places[number];
        if (abi::is_other_shape(place))
            return table[place & abi::place_mask];
        Record record;
        make_record(scene, place, record);
        return record;
    });
}

/// Planes and spheres (abi::SurfaceRecord).
template <class Real>
inline GradientPacket<Real> round_gradient(const abi::SceneView<Real>& scene,
                                           const Vec3v<Real>& point, const vint<Real>& surface,
                                           std::uint32_t active)
{
    const auto record = surface_records<8>(scene, scene.surfaces, surface, active);
    const Vec3v<Real> p = point - record.vector(0);
    return {madd<Real>(record.field[6], p, record.vector(3)), record.field[7], p};
}

/// Surfaces of every kind (abi::CurvedSurfaceRecord).
template <class Real>
inline GradientPacket<Real> curved_gradient(const abi::SceneView<Real>& scene,
                                            const Vec3v<Real>& point, const vint<Real>& surface,
                                            std::uint32_t active)
{
    const auto record = surface_records<13>(scene, scene.curved_surfaces, surface, active);
    const Vec3v<Real> p = point - record.vector(0);
    const Vec3v<Real> n = record.vector(3);
    const auto& g = record.field;
    // The diagonal comes last, so that planes and spheres get the bits of round_gradient().
    const vreal<Real> x = madd(g[6], p.x, madd(g[9], p.y, madd(g[10], p.z, n.x)));
    const vreal<Real> y = madd(g[7], p.y, madd(g[9], p.x, madd(g[11], p.z, n.y)));
    const vreal<Real> z = madd(g[8], p.z, madd(g[10], p.x, madd(g[11], p.y, n.z)));
    return {{x, y, z}, g[12], p};
}

/// The sum of |a_i| |b_i|.
template <class Real>
inline vreal<Real> magnitude_dot(const Vec3v<Real>& a, const Vec3v<Real>& b)
{
    return madd(abs(a.x), abs(b.x), madd(abs(a.y), abs(b.y), abs(a.z) * abs(b.z)));
}

/// How much of a point's size counts in its lift where its coordinate across the surface is near
/// 0: points that are solved in double for floats are off by double's roundoffs then.
template <class Real>
inline constexpr Real size_share = sizeof(Real) == sizeof(float) ? Real(0x1p-20) : Real(1);

/// Fills `lift`: along the outward normal by what rounding can do to a point there and to the
/// surface's equation, after Pharr, Jakob and Humphreys, Physically Based Rendering, section 6.8.
template <class Real>
inline void set_lift(SurfacePacket<Real>& surface, const abi::SceneView<Real>& scene,
                     const Vec3v<Real>& outward, const Vec3v<Real>& from_anchor)
{
    const Vec3v<Real>& p = surface.point;
    const vreal<Real> size = madd(vreal<Real>(size_share<Real>), abs(p.x) + abs(p.y) + abs(p.z),
                                  magnitude_dot(outward, p) + magnitude_dot(outward, from_anchor));
    surface.lift = scale<Real>(vreal<Real>(scene.start_error) * size, outward);
}

/// 0 stays 0.
template <class Real>
inline Vec3v<Real> unit(const Vec3v<Real>& v)
{
    const vreal<Real> zero(Real(0));
    const vreal<Real> length2 = dot(v, v);
    return scale<Real>(select(length2 > zero, vreal<Real>(Real(1)) / sqrt(length2), zero), v);
}

/// The unit normal of hits of rays along `dir`. Where the gradient vanishes, at a cone's apex or
/// the edge of crossing planes, it is the unit vector against the ray.
template <class Real>
inline Vec3v<Real> outward_normal(const Vec3v<Real>& gradient, const Vec3v<Real>& dir, bool is_unit)
{
    const Vec3v<Real> outward = is_unit ? gradient : unit<Real>(gradient);
    const auto is_there = dot(outward, outward) > vreal<Real>(Real(0.5));
    const Vec3v<Real> against = scale<Real>(vreal<Real>(Real(-1)) / sqrt(dot(dir, dir)), dir);
    return select(is_there, outward, against);
}

/// What n·d has to be above for a ray to come from the inside. With SelfHits::exact the side that
/// a ray comes from is the one its children start on; one that grazes the surface to within what
/// single precision tells apart comes from outside, as inside no ray does so that does not start
/// there.
template <class Real>
inline vreal<Real> grazing(const abi::SceneView<Real>& scene, const Vec3v<Real>& outward,
                           const Vec3v<Real>& dir)
{
    if (sizeof(Real) != sizeof(float) || !(scene.start_error > 0))
        return vreal<Real>(Real(0));
    return vreal<Real>(Real(4) * scene.start_error) * magnitude_dot(outward, dir);
}

/// Fills `normal`, `lift` and `leaving`.
template <class Real>
inline void set_normal(SurfacePacket<Real>& surface, const abi::SceneView<Real>& scene,
                       const GradientPacket<Real>& from, bool is_unit)
{
    const vreal<Real> zero(Real(0));
    const Vec3v<Real> outward = outward_normal(from.gradient, surface.dir, is_unit);
    const auto leaving = dot(outward, surface.dir) > grazing(scene, outward, surface.dir);
    const auto turn = (from.faces_viewer > zero) & leaving;
    surface.leaving = bits(leaving);
    surface.lift = {zero, zero, zero};
    if (scene.start_error > 0)
        set_lift(surface, scene, outward, from.from_anchor);
    surface.normal = select(turn, scale<Real>(vreal<Real>(Real(-1)), outward), outward);
}

/// 0 or 1 where the squares have their first or their other colour.
template <class Real>
inline vint<Real> checker_parity(const abi::CheckerRecord<Real>& checker, const Vec3v<Real>& point)
{
    const Vec3v<Real> p = point - broadcast(checker.point);
    const vreal<Real> squares =
        floor<Real>(dot(broadcast(checker.u), p)) + floor<Real>(dot(broadcast(checker.v), p));
    const vreal<Real> half = squares * vreal<Real>(Real(0.5));
    const auto odd = floor<Real>(half) < half;
    return select(odd, vint<Real>(lane_int<Real>(1)), vint<Real>(lane_int<Real>(0)));
}

/// Fills `material` and `object`.
template <class Real>
inline void set_material(SurfacePacket<Real>& surface, const abi::SceneView<Real>& scene,
                         const vint<Real>& number, std::uint32_t active)
{
    const auto material_of = [&](const abi::MaterialIndex& index) {
        const vint<Real> first(static_cast<lane_int<Real>>(index.first));
        return index.checker < 0
                   ? first
                   : first + checker_parity(scene.checkers[index.checker], surface.point);
    };
    const auto object_of = [](const abi::MaterialIndex& index) {
        return vint<Real>(static_cast<lane_int<Real>>(index.object));
    };
    DistinctNumbers<Real> distinct(number, active);
    surface.material = material_of(scene.material_index[distinct.value()]);
    surface.object = object_of(scene.material_index[distinct.value()]);
    while (distinct.next()) {
        const abi::MaterialIndex& index = scene.material_index[distinct.value()];
        surface.material = select(distinct.lanes_of(), material_of(index), surface.material);
        surface.object = select(distinct.lanes_of(), object_of(index), surface.object);
    }
}

/// The surface's own gradient at `point`.
template <abi::Features F, class Real>
inline GradientPacket<Real> gradient_at(const abi::SceneView<Real>& scene, const Vec3v<Real>& point,
                                        const vint<Real>& number, std::uint32_t active)
{
    if constexpr (F.quadrics)
        return curved_gradient(scene, point, number, active);
    else
        return round_gradient(scene, point, number, active);
}

/// `finished` is the unit gradient that double found, where the scene's hits are solved again.
template <abi::Features F, class Real>
inline SurfacePacket<Real> surface_at(const abi::SceneView<Real>& scene, const Vec3v<Real>& point,
                                      const Vec3v<Real>& dir, const vint<Real>& number,
                                      std::uint32_t active, const Vec3v<Real>* finished = nullptr)
{
    SurfacePacket<Real> surface;
    surface.point = point;
    surface.dir = dir;
    surface.number = number;
    GradientPacket<Real> gradient = gradient_at<F>(scene, point, number, active);
    if (finished != nullptr)
        gradient.gradient = *finished;
    set_normal(surface, scene, gradient, finished != nullptr);
    surface.inverse_length = vreal<Real>(Real(1)) / sqrt(dot(dir, dir));
    set_material(surface, scene, number, active);
    return surface;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
