#pragma once

#include "kernels/shade/shadow.hpp"
#include "kernels/stream/occluded_rays.hpp"

// Which of the caller's points a light reaches, by the same shadow rays as in frames.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The data prepared for one call.
template <abi::Features F, class Real>
struct LitWork {
    FromPoint<F, Real> from_light;
    FromAnywhere<F, Real> from_points;  ///< used instead for light from a direction
    RayBundle<Real>* bundle = nullptr;
    std::size_t bytes = 0;

    /// With a null `scratch`, only `bytes` is valid.
    LitWork(void* scratch, const abi::SceneView<Real>& casters)
    {
        Arena arena(scratch);
        take_objects<F>(arena, from_light, casters);
        take_objects<F>(arena, from_points, casters);
        bundle = take_bundle<F, Real>(arena);
        bytes = arena.used();
    }
};

/// The outward unit normals at points of one surface.
template <abi::Features F, class Real>
inline Vec3v<Real> outward_at(const abi::ShapesView& shapes, const abi::SurfaceIndex& index,
                              const Vec3v<Real>& point, const Vec3v<Real>& to_light)
{
    if constexpr (F.exact)
        return narrow(
            surface_normal<double>(shapes, index, widen_low(point), widen_low(to_light)),
            surface_normal<double>(shapes, index, widen_high(point), widen_high(to_light)));
    else
        return surface_normal<Real>(shapes, index, point, to_light);
}

/// A packet of points, and their surfaces.
template <class Real>
struct GivenPoints {
    SurfacePacket<Real> surface;
    LightPacket<Real> light;
    std::uint32_t numbers;  ///< lanes in which no coordinate is NaN
    std::uint32_t on_any;   ///< lanes on a surface
};

template <abi::Features F, class Real>
inline GivenPoints<Real> points_at(const abi::SceneView<Real>& scene,
                                   const abi::PointsView<Real>& view,
                                   const abi::LightRecord<Real>& light, int first)
{
    const int count = view.count - first;
    const vreal<Real> zero(Real(0));
    GivenPoints<Real> points{};
    SurfacePacket<Real>& surface = points.surface;
    surface.point = load_some3(view.point, first, count);
    surface.normal = surface.offset = {zero, zero, zero};
    surface.number = no_surface<Real>();
    surface.turned = 0;
    const Vec3v<Real>& at = surface.point;
    points.numbers = bits((at.x == at.x) & (at.y == at.y) & (at.z == at.z));
    Vec3v<Real>& to_light = points.light.to_light;
    to_light = broadcast(light.vector);
    if (light.kind == abi::LightKind::point)
        to_light = to_light - at;
    points.light.inverse_length = vreal<Real>(Real(1)) / sqrt(dot(to_light, to_light));
    if (view.surface == nullptr || !(scene.rules.start_error > 0))
        return points;

    surface.number = load_numbers<Real>(view.surface + first, count);
    points.on_any =
        first_lanes<Real>(count) & ~bits(int_less(surface.number, vint<Real>(lane_int<Real>(0))));
    for_each_distinct<Real>(
        surface.number, points.on_any, [&](lane_int<Real> number, const vmask<Real>& same) {
            const Vec3v<Real> outward =
                outward_at<F>(scene.shapes, scene.shapes.index[number], at, to_light);
            surface.normal =
                select(from_bits<Real>(bits(same) & points.on_any), outward, surface.normal);
        });
    surface.offset = origin_offset<Real>(scene.rules.start_error, at, surface.normal);
    return points;
}

/// Fills a bundle with the shadow rays between the points from `begin` on and a light. Points that
/// their own object occludes are not active.
template <abi::Features F, class Real>
inline void gather_ways(const abi::SceneView<Real>& scene, const abi::PointsView<Real>& view,
                        const abi::LightRecord<Real>& light, int begin, int count,
                        RayBundle<Real>& bundle)
{
    for (int first = 0; first < count; first += lanes<Real>) {
        const GivenPoints<Real> points = points_at<F>(scene, view, light, begin + first);
        const std::uint32_t by_own = points.on_any == 0 ? 0
                                                        : own_shadow(scene, light, points.light,
                                                                     points.surface, points.on_any);
        const std::uint32_t open = first_lanes<Real>(count - first) & points.numbers & ~by_own;
        with_shadow_ray(scene, light, points.light, points.surface,
                        [&](const vreal<Real>& t_end, const RayPacket<Real>& rays) {
                            start_segments<F>(bundle, first, rays, t_end, points.surface.number,
                                              open);
                        });
    }
    end_bundle(bundle, count);
}

/// Prepares the lists for the rays of a bundle, which start at points.
template <abi::Features F, class Real>
inline void find_from_points(LitWork<F, Real>& work, const abi::SceneView<Real>& casters, int count)
{
    if constexpr (F.exact) {
        const RayBundle<Real>& bundle = *work.bundle;
        const Box<float> box = box_of(bundle.org, count);
        find_objects<F>(work.from_points, origins_in(box.low, box.high), casters);
    } else {
        find_objects<F>(work.from_points, Cone<Real>{}, casters);
    }
}

/// Ends the rays of a bundle that any object occludes.
template <abi::Features F, class Objects, class Real>
[[gnu::noinline]] void block_ways(const abi::SceneView<Real>& casters, const Objects& objects,
                                  RayBundle<Real>& bundle, RayInterval interval,
                                  const abi::LightBuffer* buffer)
{
    visit_occluders_of_bundle<F>(casters, objects, bundle, interval, Occluder(), buffer);
    if constexpr (F.exact)
        decide_occluded<F>(casters, bundle, interval);
}

/// Sets mask[i] to 1 if no object that casts shadows is between point i and a light, else to 0.
/// Points on surfaces are handled as in frames: their own object by the other root of its equation,
/// other objects by rays with an origin offset.
template <abi::Features F, class Real>
inline void lit_points(const abi::SceneView<Real>& scene, const abi::PointsView<Real>& view,
                       const abi::LightRecord<Real>& light, const abi::LightBuffer* buffer,
                       std::uint8_t* mask, void* scratch)
{
    const abi::SceneView<Real>& casters = casters_of(scene);
    LitWork<F, Real> work(scratch, casters);
    RayBundle<Real>& bundle = *work.bundle;
    const RayInterval interval = shadow_interval(scene, light);
    if (light.sends_rays) {
        find_from_point<F>(work.from_light, light.vector, casters);
        sort_by_distance<F>(work.from_light);
    }
    for (int begin = 0; begin < view.count; begin += bundle_rays) {
        const int count = view.count - begin < bundle_rays ? view.count - begin : bundle_rays;
        gather_ways<F>(scene, view, light, begin, count, bundle);
        if (light.sends_rays) {
            block_ways<F>(casters, work.from_light, bundle, interval, buffer);
        } else {
            find_from_points(work, casters, count);
            block_ways<F>(casters, work.from_points, bundle, interval, buffer);
        }
        for (int first = 0; first < count; first += lanes<Real>)
            store_mask<Real>(mask + begin + first, active_lanes(bundle, first), count - first);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
