#pragma once

#include "kernels/fused/path.hpp"
#include "kernels/shade/shadow.hpp"

// Whether a light reaches hits. Mostly a few products show that no object is in between (plan.hpp).
// If they do not, shadow rays are traced as for streams (shade/shadow.hpp).
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The lanes of `among` that are not on `body`.
inline std::uint32_t on_others(const HitState& at, std::uint32_t among, const Body& body)
{
    return at.common >= 0 || among == 0
               ? among
               : among & ~lanes_on_body<float>(at.number, body.first, body.pieces);
}

/// The lanes of `wanted` that the planes in front of a light's large objects do not decide.
inline std::uint32_t behind_planes(const NeededTests& needed, const HitState& at,
                                   std::uint32_t wanted)
{
    std::uint32_t open = 0;
    for (const FrontPlane* plane : needed.planes) {
        const vreal<float> level = dot(broadcast(plane->normal), at.point);
        open |=
            on_others(at, wanted & ~bits(level > vreal<float>(plane->offset)), Body{plane->behind});
    }
    return open;
}

/// The result of the quick tests: lanes that are certainly in shadow, and lanes that are not
/// decided.
struct QuickShadow {
    std::uint32_t blocked = 0;
    std::uint32_t open = 0;
};

/// Tests the lanes of `wanted` towards a directional light.
inline QuickShadow shadow_along(const ClearTests& tests, const HitState& at,
                                const Vec3v<float>& light, std::uint32_t wanted)
{
    const NeededTests& needed = tests.needed[at.common];
    QuickShadow shadow;
    shadow.open = behind_planes(needed, at, wanted);
    if (needed.across.empty())
        return shadow;
    const vreal<float> first = dot(broadcast(tests.axis[0]), at.point);
    const vreal<float> second = dot(broadcast(tests.axis[1]), at.point);
    for (const AcrossSphere* across : needed.across) {
        const AcrossSphere& sphere = *across;
        const vreal<float> x = first - vreal<float>(sphere.center[0]);
        const vreal<float> y = second - vreal<float>(sphere.center[1]);
        const vreal<float> distance2 = madd(x, x, y * y);
        std::uint32_t near = wanted & ~bits(distance2 > vreal<float>(sphere.outer2));
        if (near == 0)
            continue;
        near = on_others(at, near, sphere.body);
        const vreal<float> along = dot(light, at.point);
        shadow.open |= near & ~bits(along > vreal<float>(sphere.along));
        shadow.blocked |= near & bits((distance2 < vreal<float>(sphere.inner2)) &
                                      (along < vreal<float>(sphere.before)));
    }
    shadow.open &= ~shadow.blocked;
    return shadow;
}

/// The same towards a point light; `to_light` leads to it and has `length`.
inline QuickShadow shadow_towards(const ClearTests& tests, const HitState& at,
                                  const Vec3v<float>& to_light, const vreal<float>& length2,
                                  const vreal<float>& length, std::uint32_t wanted)
{
    const NeededTests& needed = tests.needed[at.common];
    const std::uint32_t too_near = wanted & ~bits(length2 > vreal<float>(tests.least_distance2));
    QuickShadow shadow;
    shadow.open = behind_planes(needed, at, wanted);
    for (const ConeSphere* cone : needed.cones) {
        const ConeSphere& sphere = *cone;
        const vreal<float> cosine = negated(dot(broadcast(sphere.to), to_light));
        std::uint32_t near = wanted & ~bits(cosine < vreal<float>(sphere.edge) * length);
        if (near == 0)
            continue;
        near = on_others(at, near, sphere.body);
        // Lanes whose segment ends outside the sphere: whether they approach its centre or move
        // away from it.
        const Vec3v<float> from = at.point - broadcast(sphere.center);
        const vreal<float> away = dot(from, to_light);
        const std::uint32_t outside = bits(dot(from, from) > vreal<float>(sphere.outer2));
        const std::uint32_t beyond = outside & bits(away > vreal<float>(0.0f));
        shadow.open |= near & ~beyond;
        shadow.blocked |=
            near & outside &
            bits((away < vreal<float>(0.0f)) & (cosine > vreal<float>(sphere.inner_edge) * length));
    }
    shadow.open = (shadow.open & ~shadow.blocked) | too_near;
    shadow.blocked &= ~too_near;
    return shadow;
}

/// The lanes of `wanted` that a light reaches, decided by tests with error bounds and, if these
/// cannot, in double.
template <abi::Features F>
[[gnu::noinline]] std::uint32_t trace_to_light(const FusedTile<F>& tile, int light,
                                               const LightObjects<F, float>* occluders,
                                               const SurfacePacket<float>& surface,
                                               const LightPacket<float>& packet,
                                               std::uint32_t wanted)
{
    const ShadeContext<F, float> context{&tile.scene, occluders,    nullptr, nullptr,
                                         0,           &tile.counts, nullptr};
    const abi::LightRecord<float>& record = tile.scene.lighting.lights.data[light];
    const std::uint32_t open = wanted & ~own_shadow(tile.scene, record, packet, surface, wanted);
    if (open == 0)
        return 0;
    return open &
           ~with_shadow_ray(tile.scene, record, packet, surface,
                            [&](const vreal<float>& t_end, const RayPacket<float>& rays) {
                                return blocked_lanes(context, light, surface, rays, t_end, open);
                            });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
