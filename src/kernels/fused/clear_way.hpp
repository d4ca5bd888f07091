#pragma once

#include "kernels/fused/path.hpp"
#include "kernels/shade/shadow.hpp"

// Whether hits see a light: mostly a few products tell that nothing is in the way (plan.hpp). Where
// they don't, shadow rays are traced as those of a stream are (shade/shadow.hpp).
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The lanes of `among` that are on other objects than `surface`; `common` is what all are on.
inline std::uint32_t on_others(const SurfacePacket<float>& at, std::uint32_t among,
                               std::int32_t surface)
{
    return among == 0 || at.common >= 0 ? among
                                        : among & ~lanes_on_body<float>(at.number, surface);
}

/// The lanes of `wanted` for which the planes in front of a light's large objects tell nothing.
inline std::uint32_t behind_planes(const ClearTests& tests, const SurfacePacket<float>& at,
                                   std::uint32_t wanted)
{
    std::uint32_t open = 0;
    for (int i = 0; i < tests.plane_count; ++i) {
        const FrontPlane& plane = tests.planes[i];
        if (at.common == plane.behind)
            continue;
        const vreal<float> level = dot(broadcast(plane.normal), at.point);
        open |= on_others(at, wanted & ~bits(level > vreal<float>(plane.offset)), plane.behind);
    }
    return open;
}

/// The lanes of `wanted` that a directional light may not reach.
inline std::uint32_t open_along(const ClearTests& tests, const SurfacePacket<float>& at,
                                const Vec3v<float>& light, std::uint32_t wanted)
{
    std::uint32_t open = behind_planes(tests, at, wanted);
    const vreal<float> first = dot(broadcast(tests.axis[0]), at.point);
    const vreal<float> second = dot(broadcast(tests.axis[1]), at.point);
    for (int i = 0; i < tests.sphere_count; ++i) {
        const AcrossSphere& sphere = tests.across[i];
        if (at.common == sphere.surface)
            continue;
        const vreal<float> x = first - vreal<float>(sphere.center[0]);
        const vreal<float> y = second - vreal<float>(sphere.center[1]);
        std::uint32_t near = wanted & ~bits(madd(x, x, y * y) > vreal<float>(sphere.outer2));
        if (near != 0)
            near &= ~bits(dot(light, at.point) > vreal<float>(sphere.along));
        open |= on_others(at, near, sphere.surface);
    }
    return open;
}

/// The same of a point light, to which `to_light` leads, of `length`.
inline std::uint32_t open_towards(const ClearTests& tests, const SurfacePacket<float>& at,
                                  const Vec3v<float>& to_light, const vreal<float>& length2,
                                  const vreal<float>& length, std::uint32_t wanted)
{
    std::uint32_t open = behind_planes(tests, at, wanted) |
                         (wanted & ~bits(length2 > vreal<float>(tests.least_distance2)));
    for (int i = 0; i < tests.sphere_count; ++i) {
        const ConeSphere& sphere = tests.cones[i];
        if (at.common == sphere.surface)
            continue;
        const vreal<float> cosine = negated(dot(broadcast(sphere.to), to_light));
        std::uint32_t near = wanted & ~bits(cosine < vreal<float>(sphere.edge) * length);
        if (near != 0) {
            // Still outside where the way ends, and nearing the centre.
            const Vec3v<float> from = at.point - broadcast(sphere.center);
            near &= ~bits((dot(from, to_light) > vreal<float>(0.0f)) &
                          (dot(from, from) > vreal<float>(sphere.outer2)));
            open |= on_others(at, near, sphere.surface);
        }
    }
    return open;
}

/// The lanes of `wanted` that see a light, by intervals and, where these can't tell, by double.
template <abi::Features F>
[[gnu::noinline]] std::uint32_t trace_to_light(const FusedTile<F>& tile, int light,
                                               const LightObjects<F, float>* occluders,
                                               SurfacePacket<float>& surface,
                                               const Vec3v<float>& outward,
                                               const LightPacket<float>& packet,
                                               std::uint32_t wanted)
{
    surface.lift =
        origin_offset<float>(tile.scene.rules.start_error, surface.point, outward);
    const ShadeContext<F, float> context{&tile.scene, occluders,    nullptr, nullptr,
                                         0,           &tile.counts, nullptr};
    const abi::LightRecord<float>& record = tile.scene.lighting.lights.data[light];
    const std::uint32_t open =
        wanted & ~own_shadow(tile.scene, record, packet, surface, wanted);
    if (open == 0)
        return 0;
    return open & ~with_shadow_ray(tile.scene, record, packet, surface,
                                   [&](const vreal<float>& t_end, const RayPacket<float>& rays) {
                                       return blocked_lanes(context, light, surface, rays, t_end,
                                                            open);
                                   });
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
