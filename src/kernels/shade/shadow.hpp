#pragma once

#include "kernels/lists/occluded.hpp"
#include "kernels/retrace/retrace_occluded.hpp"
#include "kernels/shade/own_shadow.hpp"
#include "kernels/shade/shade_context.hpp"

#include <limits>

// Shadow rays of a packet. Those of a point light are traced from it, where they share their
// origin: t there is 1 - t of the notes' ray from the point. Those of a light from a direction, or
// of one so far that its rays would be off at the point, start there.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// How far the segment from the light goes: up to epsilon before the point, which counts in
/// lengths of the segment or, for unit directions, of space.
template <class Real>
inline vreal<Real> segment_end(const abi::SceneView<Real>& scene, const LightPacket<Real>& packet)
{
    const vreal<Real> one(Real(1));
    const vreal<Real> epsilon(scene.rules.secondary_t_min);
    return scene.rules.units == abi::RayUnits::unit ? nmadd(epsilon, packet.inverse_length, one)
                                                    : one - epsilon;
}

/// Where the way between a hit and a light ends at the hit: on the light's side of the surface,
/// lifted off it also by what rounding a segment as long as that can do.
template <class Real>
inline Vec3v<Real> lit_point(const abi::SceneView<Real>& scene, const SurfacePacket<Real>& surface,
                             const Vec3v<Real>& to_light, bool segment)
{
    if (!(scene.rules.start_error > 0))
        return surface.point;
    const auto inside = from_bits<Real>(~outside_towards(surface, to_light) & all_lanes<Real>);
    Vec3v<Real> lift = surface.lift;
    if (segment) {
        const vreal<Real> more =
            vreal<Real>(scene.rules.start_error) * magnitude_dot(surface.normal, to_light);
        const auto turned = from_bits<Real>(surface.turned & all_lanes<Real>);
        lift = madd<Real>(select(turned, negated(more), more), surface.normal, lift);
    }
    return select(inside, surface.point - lift, surface.point + lift);
}

/// The surface that shadow rays from a place on it don't meet by looking: its own with
/// SelfHits::exact, else none.
template <class Real>
inline vint<Real> own_of(const abi::SceneView<Real>& scene, const SurfacePacket<Real>& surface)
{
    return scene.rules.start_error > 0 ? surface.number : no_surface<Real>();
}

/// The same for a packet against all objects of a list; any lane is `active`.
template <class Real>
inline OwnSurface<vint<Real>> common_own_of(const abi::SceneView<Real>& scene,
                                            const SurfacePacket<Real>& surface,
                                            std::uint32_t active)
{
    if (!(scene.rules.start_error > 0))
        return {no_surface<Real>()};
    if (surface.common >= 0)
        return {surface.number, static_cast<std::int32_t>(surface.common)};
    const DistinctNumbers<Real> distinct(surface.number, active);
    return own_with_common<Real>(surface.number, distinct.value(), active);
}

/// Where the way from a point to a light begins that sends no rays: behind the point itself, so
/// that what is met exactly there is not in the way, also where rules let rays start at 0. The
/// least normal number, as products with it keep the sign that decides (root_between).
template <class Real>
inline Real way_begin(const abi::SceneView<Real>& scene)
{
    constexpr Real least = std::numeric_limits<Real>::min();
    return scene.rules.secondary_t_min > least ? scene.rules.secondary_t_min : least;
}

/// The rays from points to a light that sends none.
template <class Real>
inline RayPacket<Real> rays_to_light(const abi::SceneView<Real>& scene,
                                     const abi::LightRecord<Real>& light,
                                     const LightPacket<Real>& packet,
                                     const SurfacePacket<Real>& surface)
{
    RayPacket<Real> rays = make_rays<Real>(lit_point(scene, surface, packet.to_light, false),
                                           packet.to_light, way_begin(scene));
    // The note's epsilon counts in space, or in lengths of the way to a point.
    if (light.kind == abi::LightKind::point && scene.rules.units == abi::RayUnits::unit)
        rays.t_min =
            max(rays.t_min * packet.inverse_length, vreal<Real>(std::numeric_limits<Real>::min()));
    return rays;
}

/// Calls `trace(t_end, rays)` for the shadow rays of one light; those along a directional one
/// have no end.
template <class Real, class Trace>
inline auto with_shadow_ray(const abi::SceneView<Real>& scene, const abi::LightRecord<Real>& light,
                            const LightPacket<Real>& packet, const SurfacePacket<Real>& surface,
                            const Trace& trace)
{
    if (!light.sends_rays)
        return trace(vreal<Real>(way_end(light)), rays_to_light(scene, light, packet, surface));
    const Vec3v<Real> from = broadcast(light.vector);
    const Vec3v<Real> way = lit_point(scene, surface, packet.to_light, true) - from;
    return trace(segment_end(scene, packet), make_rays<Real>(from, way, Real(0)));
}

/// Whether the reach of shadow rays is closed (occluded.hpp).
template <class Real>
inline bool has_closed_reach(const abi::SceneView<Real>& scene, const abi::LightRecord<Real>& light)
{
    return !light.sends_rays || !(scene.rules.start_error > 0);
}

/// Calls `visit(objects)` with what may be in the way of a light.
template <abi::Features F, class Real, class Visit>
inline auto with_light_objects(const ShadeContext<F, Real>& context, int light, const Visit& visit)
{
    const LightObjects<F, Real>& objects = context.occluders[light];
    return context.scene->lighting.lights.data[light].sends_rays ? visit(objects.from_point)
                                                                 : visit(objects.along);
}

/// The lanes of `open` that anything but their own surface keeps from a light.
template <abi::Features F, class Real>
inline std::uint32_t blocked_lanes(const ShadeContext<F, Real>& context, int light,
                                   const SurfacePacket<Real>& surface, const RayPacket<Real>& rays,
                                   const vreal<Real>& t_end, std::uint32_t open)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const OwnSurface<vint<Real>> own = common_own_of(scene, surface, open);
    const bool closed = has_closed_reach(scene, scene.lighting.lights.data[light]);
    return with_light_objects(context, light, [&](const auto& objects) -> std::uint32_t {
        if constexpr (F.exact) {
            const Occlusion occlusion = occluded<F>(t_end, objects, rays, own, open);
            if (occlusion.unsure == 0)
                return occlusion.blocked;
            count_unsure(*context.counts, occlusion.unsure);
            count_unsure_shadows(occlusion.unsure);
            return occlusion.blocked | retrace_occluded<F.probe>(*casters_of(scene).wide, rays,
                                                                 own.surface, t_end, closed,
                                                                 occlusion.unsure);
        } else {
            return occluded<F>(RayEnd<Real>{t_end, closed}, objects, rays, own, open);
        }
    });
}

/// Calls `pass_on(surface, lanes)` for each object in the way of a light with the lanes it blocks,
/// until that returns false; `start_again(lanes)` for lanes that are looked at again from the
/// start.
template <abi::Features F, class Real, class PassOn, class StartAgain>
inline void visit_light_occluders(const ShadeContext<F, Real>& context, int light,
                                  const SurfacePacket<Real>& surface, const RayPacket<Real>& rays,
                                  const vreal<Real>& t_end, std::uint32_t wanted,
                                  const PassOn& pass_on, const StartAgain& start_again)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const OwnSurface<vint<Real>> own = common_own_of(scene, surface, wanted);
    const bool closed = has_closed_reach(scene, scene.lighting.lights.data[light]);
    with_light_objects(context, light, [&](const auto& objects) {
        if constexpr (F.exact) {
            const std::uint32_t unsure =
                visit_occluders<F>(t_end, objects, rays, own, pass_on) & wanted;
            if (unsure == 0)
                return;
            count_unsure(*context.counts, unsure);
            count_unsure_shadows(unsure);
            start_again(unsure);
            WideBundle bundle;
            add_segments(bundle, 0, rays, own.surface, t_end, unsure);
            block_wide<F.probe>(*casters_of(scene).wide, bundle, closed, Occluders::all,
                                [&](int lane, std::int32_t occluder) {
                                    pass_on(occluder, 1u << lane);
                                    return false;
                                });
        } else {
            visit_occluders<F>(RayEnd<Real>{t_end, closed}, objects, rays, own, pass_on);
        }
    });
}

/// Whether no object may be in the way of a light for the lanes of `open`; in exact mode but their
/// own, and only if bounds hold for the segments: with a margin, as rays start off their surfaces.
template <abi::Features F, class Real>
inline bool nothing_between(const ShadeContext<F, Real>& context, int light,
                            const LightPacket<Real>& packet, const SurfacePacket<Real>& surface,
                            std::uint32_t open)
{
    if constexpr (F.exact) {
        const auto certain = (packet.inverse_length > vreal<Real>(1e-8f)) &
                             (packet.inverse_length < vreal<Real>(1e8f));
        if ((open & ~bits(certain)) != 0)
            return false;
        const auto own = common_own_of(*context.scene, surface, open);
        return with_light_objects(context, light, [&](const auto& objects) {
            return objects.certifiable &&
                   (objects.empty() || (objects.count == 1 && own.all_on(objects.one)));
        });
    } else {
        return with_light_objects(context, light,
                                  [](const auto& objects) { return objects.empty(); });
    }
}

inline void count_shadow_rays(abi::RayCounts& counts, int first, std::uint32_t traced)
{
    count_shadow_pixels(first, traced);
    counts.shadow += static_cast<unsigned>(__builtin_popcount(traced));
    counts.passed |= abi::passed_shadow_rays;
}

/// Lanes of `wanted` that no opaque or any other object keeps from the light.
template <abi::Features F, class Real>
inline std::uint32_t unshadowed(const ShadeContext<F, Real>& context, int light,
                                const LightPacket<Real>& packet, const SurfacePacket<Real>& surface,
                                std::uint32_t wanted, int first)
{
    if (!context.scene->lighting.lights.data[light].casts_shadow || wanted == 0)
        return wanted;
    count_shadow_rays(*context.counts, first, wanted);
    if (context.has_shadows(light))
        return count_lit<Real>(wanted, wanted & context.shadows[light].lit_lanes(first));
    const ShadowScope shadow(abi::Step::ray_generation);
    tell_live(wanted);
    tell_first(first);
    const abi::SceneView<Real>& scene = *context.scene;
    const abi::LightRecord<Real>& record = scene.lighting.lights.data[light];
    const std::uint32_t open = wanted & ~own_shadow(scene, record, packet, surface, wanted);
    if (open == 0 || nothing_between(context, light, packet, surface, open))
        return count_lit<Real>(wanted, open);
    return count_lit<Real>(
        wanted, open & ~with_shadow_ray(scene, record, packet, surface,
                                        [&](const vreal<Real>& t_end, const RayPacket<Real>& rays) {
                                            return blocked_lanes(context, light, surface, rays,
                                                                 t_end, open);
                                        }));
}

/// Lanes in which any channel is above 0.
template <class Real>
inline std::uint32_t any_channel(const Vec3v<Real>& v)
{
    const vreal<Real> zero(Real(0));
    return bits((v.x > zero) | (v.y > zero) | (v.z > zero));
}

/// The share of the light that gets through: the product of what each blocking object
/// transmits, once however often the segment crosses it.
template <abi::Features F, class Real>
inline Vec3v<Real> transmitted(const ShadeContext<F, Real>& context, int light,
                               const LightPacket<Real>& packet, const SurfacePacket<Real>& surface,
                               std::uint32_t wanted, int first)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const vreal<Real> one(Real(1));
    Vec3v<Real> share{one, one, one};
    count_shadow_rays(*context.counts, first, wanted);
    context.counts->passed |= abi::passed_glass_shadows;
    if (context.has_shadows(light))
        return context.shadows[light].shares(first);
    const ShadowScope shadow(abi::Step::ray_generation);
    tell_live(wanted);
    tell_first(first);
    const auto pass_on = [&](std::int32_t occluder, std::uint32_t blocked) {
        if ((blocked & wanted) == 0)
            return true;
        const auto& material = scene.materials.records[scene.materials.of_surface[occluder].first];
        share = select(from_bits<Real>(blocked), share * broadcast(material.transmit), share);
        return (any_channel(share) & wanted) != 0;
    };
    const abi::LightRecord<Real>& record = scene.lighting.lights.data[light];
    const std::uint32_t by_own = own_shadow(scene, record, packet, surface, wanted);
    const auto pass_on_own = [&](std::uint32_t lanes_of) {
        for_each_distinct<Real>(
            surface.number, lanes_of, [&](lane_int<Real> number, vmask<Real> same) {
                pass_on(static_cast<std::int32_t>(number), bits(same) & lanes_of);
            });
    };
    pass_on_own(by_own);
    // An object takes its share once, also where its other pieces are in the way.
    const auto pass_on_once = [&](std::int32_t occluder, std::uint32_t blocked) {
        const vint<Real> object(lane_int<Real>{scene.materials.of_surface[occluder].object});
        return pass_on(occluder, blocked & ~(by_own & bits(int_equal(surface.object, object))));
    };
    const auto start_again = [&](std::uint32_t lanes_of) {
        share = select(from_bits<Real>(lanes_of), {one, one, one}, share);
        pass_on_own(by_own & lanes_of);
    };
    with_shadow_ray(scene, record, packet, surface,
                    [&](const vreal<Real>& t_end, const RayPacket<Real>& rays) {
                        visit_light_occluders(context, light, surface, rays, t_end, wanted,
                                              pass_on_once, start_again);
                    });
    return share;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
