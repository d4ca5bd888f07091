#pragma once

#include "kernels/lists/occluded.hpp"
#include "kernels/retrace/retrace_occluded.hpp"
#include "kernels/shade/own_shadow.hpp"
#include "kernels/shade/shade_context.hpp"

#include <limits>

// Shadow rays of a packet. Those of a point light start at the light, so that they share their
// origin; their t is 1 - t of the note's ray from the point. Those of a directional light start at
// the points. So do those of a point light so far away that rays from it would miss the point by
// rounding.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The t at which the segment from the light ends: epsilon before the point. Epsilon counts in
/// lengths of the segment or, for unit directions, in units of space.
template <class Real>
inline vreal<Real> segment_end(const abi::SceneView<Real>& scene, const LightPacket<Real>& packet)
{
    const vreal<Real> one(Real(1));
    const vreal<Real> epsilon(scene.rules.secondary_t_min);
    return scene.rules.units == abi::RayUnits::unit ? nmadd(epsilon, packet.inverse_length, one)
                                                    : one - epsilon;
}

/// Where a shadow ray starts.
enum class ShadowRay { from_light, from_point };

/// The end of a shadow segment at a hit: offset to the light's side of the surface. A segment from
/// the light is long, so its offset also includes the rounding error of its length.
template <class Real>
inline Vec3v<Real> lit_point(const abi::SceneView<Real>& scene, const SurfacePacket<Real>& surface,
                             const Vec3v<Real>& to_light, ShadowRay ray)
{
    if (!(scene.rules.start_error > 0))
        return surface.point;
    const auto inside = from_bits<Real>(~outside_towards(surface, to_light) & all_lanes<Real>);
    Vec3v<Real> offset = surface.offset;
    if (ray == ShadowRay::from_light) {
        const vreal<Real> more =
            vreal<Real>(scene.rules.start_error) * magnitude_dot(surface.normal, to_light);
        const auto turned = from_bits<Real>(surface.turned & all_lanes<Real>);
        offset = madd<Real>(select(turned, negated(more), more), surface.normal, offset);
    }
    return select(inside, surface.point - offset, surface.point + offset);
}

/// The surface that shadow rays start on and skip: with SelfHits::exact that of the hit, else none.
template <class Real>
inline vint<Real> own_of(const abi::SceneView<Real>& scene, const SurfacePacket<Real>& surface)
{
    return scene.rules.start_error > 0 ? surface.number : no_surface<Real>();
}

/// The same for tests of a packet against all objects of a list; any lane is `active`.
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

/// The t at which shadow rays from a point to a light start. It is above 0, so that a surface
/// exactly at the point does not occlude, even if the rules let rays start at 0. It is the smallest
/// normal number, because products with it keep the sign that decides (root_between).
template <class Real>
inline Real way_begin(const abi::SceneView<Real>& scene)
{
    constexpr Real least = std::numeric_limits<Real>::min();
    return scene.rules.secondary_t_min > least ? scene.rules.secondary_t_min : least;
}

/// The shadow rays from points to a light that sends no rays.
template <class Real>
inline RayPacket<Real> rays_to_light(const abi::SceneView<Real>& scene,
                                     const abi::LightRecord<Real>& light,
                                     const LightPacket<Real>& packet,
                                     const SurfacePacket<Real>& surface)
{
    RayPacket<Real> rays =
        make_rays<Real>(lit_point(scene, surface, packet.to_light, ShadowRay::from_point),
                        packet.to_light, way_begin(scene));
    // The note's epsilon counts in units of space, or in lengths of the segment.
    if (light.kind == abi::LightKind::point && scene.rules.units == abi::RayUnits::unit)
        rays.t_min =
            max(rays.t_min * packet.inverse_length, vreal<Real>(std::numeric_limits<Real>::min()));
    return rays;
}

/// Calls `trace(t_end, rays)` for the shadow rays of one light; those of a directional light have
/// no end.
template <class Real, class Trace>
inline auto with_shadow_ray(const abi::SceneView<Real>& scene, const abi::LightRecord<Real>& light,
                            const LightPacket<Real>& packet, const SurfacePacket<Real>& surface,
                            const Trace& trace)
{
    if (!light.sends_rays)
        return trace(vreal<Real>(way_end(light)), rays_to_light(scene, light, packet, surface));
    const Vec3v<Real> from = broadcast(light.vector);
    const Vec3v<Real> way =
        lit_point(scene, surface, packet.to_light, ShadowRay::from_light) - from;
    return trace(segment_end(scene, packet), make_rays<Real>(from, way, Real(0)));
}

/// The interval of the shadow rays of a light.
template <class Real>
inline RayInterval shadow_interval(const abi::SceneView<Real>& scene,
                                   const abi::LightRecord<Real>& light)
{
    return !light.sends_rays || !(scene.rules.start_error > 0) ? RayInterval::closed
                                                               : RayInterval::open;
}

/// Calls `visit(objects)` with the objects that may occlude a light.
template <abi::Features F, class Real, class Visit>
inline auto with_light_objects(const ShadeContext<F, Real>& context, int light, const Visit& visit)
{
    const LightObjects<F, Real>& objects = context.occluders[light];
    return context.scene->lighting.lights.data[light].sends_rays ? visit(objects.from_point)
                                                                 : visit(objects.along);
}

/// The lanes of `open` in which any object except their own occludes a light.
template <abi::Features F, class Real>
inline std::uint32_t blocked_lanes(const ShadeContext<F, Real>& context, int light,
                                   const SurfacePacket<Real>& surface, const RayPacket<Real>& rays,
                                   const vreal<Real>& t_end, std::uint32_t open)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const OwnSurface<vint<Real>> own = common_own_of(scene, surface, open);
    const RayInterval interval = shadow_interval(scene, scene.lighting.lights.data[light]);
    return with_light_objects(context, light, [&](const auto& objects) -> std::uint32_t {
        if constexpr (F.exact) {
            const Occlusion occlusion = occluded<F>(t_end, objects, rays, own, open);
            if (occlusion.unsure == 0)
                return occlusion.blocked;
            count_unsure(*context.counts, occlusion.unsure);
            count_unsure_shadows(occlusion.unsure);
            return occlusion.blocked | retrace_occluded<F.probe>(*casters_of(scene).wide, rays,
                                                                 own.surface, t_end, interval,
                                                                 occlusion.unsure);
        } else {
            return occluded<F>(RayEnd<Real>{t_end, interval}, objects, rays, own, open);
        }
    });
}

/// Calls `pass_on(surface, lanes)` for each occluder of a light with the lanes that it occludes,
/// until it returns false. `start_again(lanes)` is called for lanes that are searched again from
/// the start.
template <abi::Features F, class Real, class PassOn, class StartAgain>
inline void visit_light_occluders(const ShadeContext<F, Real>& context, int light,
                                  const SurfacePacket<Real>& surface, const RayPacket<Real>& rays,
                                  const vreal<Real>& t_end, std::uint32_t wanted,
                                  const PassOn& pass_on, const StartAgain& start_again)
{
    const abi::SceneView<Real>& scene = *context.scene;
    const OwnSurface<vint<Real>> own = common_own_of(scene, surface, wanted);
    const RayInterval interval = shadow_interval(scene, scene.lighting.lights.data[light]);
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
            block_wide<F.probe>(*casters_of(scene).wide, bundle, interval, Occluders::all,
                                [&](int lane, std::int32_t occluder) {
                                    pass_on(occluder, 1u << lane);
                                    return false;
                                });
        } else {
            visit_occluders<F>(RayEnd<Real>{t_end, interval}, objects, rays, own, pass_on);
        }
    });
}

/// Whether no object can occlude a light in the lanes of `open`. In exact mode their own object
/// does not count, and error bounds have to hold for the segments, with a margin for origin
/// offsets.
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

/// The lanes of `wanted` that the light reaches past all objects, opaque or not.
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
    record_live(wanted);
    record_first(first);
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

/// The share of a light that reaches a packet of hits: the product of what each occluder transmits,
/// once per occluder however often the segment hits it.
template <class Real>
class TransmittedShare {
public:
    /// `by_own` are the lanes that their own object occludes.
    TransmittedShare(const abi::SceneView<Real>& scene, const SurfacePacket<Real>& surface,
                     std::uint32_t wanted, std::uint32_t by_own)
        : scene_(scene), surface_(surface), wanted_(wanted), by_own_(by_own)
    {
        pass_on_own(by_own);
    }

    /// An occluder in the lanes of `blocked`, which counts once even if it is the own object of
    /// lanes. Returns whether any lane still receives light.
    bool pass_on(std::int32_t occluder, std::uint32_t blocked)
    {
        const vint<Real> object(lane_int<Real>{scene_.materials.of_surface[occluder].object});
        return multiply(occluder, blocked & ~(by_own_ & bits(int_equal(surface_.object, object))));
    }

    /// Resets some lanes to their own object's share.
    void start_again(std::uint32_t lanes_of)
    {
        const vreal<Real> one(Real(1));
        share_ = select(from_bits<Real>(lanes_of), {one, one, one}, share_);
        pass_on_own(by_own_ & lanes_of);
    }

    [[nodiscard]] const Vec3v<Real>& share() const
    {
        return share_;
    }

private:
    bool multiply(std::int32_t occluder, std::uint32_t blocked)
    {
        if ((blocked & wanted_) == 0)
            return true;
        const abi::MaterialIndex& index = scene_.materials.of_surface[occluder];
        const auto& material = scene_.materials.records[index.first];
        share_ = select(from_bits<Real>(blocked), share_ * broadcast(material.transmit), share_);
        return (any_channel(share_) & wanted_) != 0;
    }

    void pass_on_own(std::uint32_t lanes_of)
    {
        for_each_distinct<Real>(
            surface_.number, lanes_of, [&](lane_int<Real> number, vmask<Real> same) {
                multiply(static_cast<std::int32_t>(number), bits(same) & lanes_of);
            });
    }

    const abi::SceneView<Real>& scene_;
    const SurfacePacket<Real>& surface_;
    std::uint32_t wanted_;
    std::uint32_t by_own_;
    Vec3v<Real> share_{vreal<Real>(Real(1)), vreal<Real>(Real(1)), vreal<Real>(Real(1))};
};

/// The share of the light that reaches the hits in the lanes of `wanted`.
template <abi::Features F, class Real>
inline Vec3v<Real> transmitted(const ShadeContext<F, Real>& context, int light,
                               const LightPacket<Real>& packet, const SurfacePacket<Real>& surface,
                               std::uint32_t wanted, int first)
{
    count_shadow_rays(*context.counts, first, wanted);
    context.counts->passed |= abi::passed_glass_shadows;
    if (context.has_shadows(light))
        return context.shadows[light].shares(first);
    const ShadowScope shadow(abi::Step::ray_generation);
    record_live(wanted);
    record_first(first);
    const abi::SceneView<Real>& scene = *context.scene;
    const abi::LightRecord<Real>& record = scene.lighting.lights.data[light];
    TransmittedShare<Real> transmitted(scene, surface, wanted,
                                       own_shadow(scene, record, packet, surface, wanted));
    const auto pass_on = [&](std::int32_t occluder, std::uint32_t blocked) {
        return transmitted.pass_on(occluder, blocked);
    };
    const auto start_again = [&](std::uint32_t lanes_of) { transmitted.start_again(lanes_of); };
    with_shadow_ray(scene, record, packet, surface,
                    [&](const vreal<Real>& t_end, const RayPacket<Real>& rays) {
                        visit_light_occluders(context, light, surface, rays, t_end, wanted, pass_on,
                                              start_again);
                    });
    return transmitted.share();
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
