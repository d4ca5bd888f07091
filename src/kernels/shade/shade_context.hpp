#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/bvh/bundle.hpp"
#include "kernels/lists/object_sets.hpp"
#include "kernels/shade/hit_points.hpp"

// What shading a tile needs besides the hits.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The shares of a light that reach the hits; only if anything transmits light.
template <bool Glass, class Real>
struct LightShares {
};
template <class Real>
struct LightShares<true, Real> {
    Real share[3][bundle_rays];
};

/// The shadows of one light at a chunk of hits.
template <abi::Features F, class Real>
struct alignas(64) LightShadows : LightShares<F.glass, Real> {
    std::uint16_t lit[bundle_cells];  ///< one bit per hit: not completely in shadow

    std::uint32_t lit_lanes(int first) const
    {
        return lit[first / cell_rays] >> first % cell_rays & all_lanes<Real>;
    }

    /// Multiplies the share of some lanes by what an occluder transmits; returns the lanes that are
    /// now dark.
    std::uint32_t dim(const abi::SceneView<Real>& scene, std::int32_t surface, int first,
                      std::uint32_t blocked)
    {
        const auto& material = scene.materials.records[scene.materials.of_surface[surface].first];
        std::uint32_t bright = 0;
        for (int channel = 0; channel < 3; ++channel) {
            Real* const at = this->share[channel] + first;
            const vreal<Real> passed = load(at) * vreal<Real>(material.transmit[channel]);
            const vreal<Real> left = select(from_bits<Real>(blocked), passed, load(at));
            store(at, left);
            bright |= bits(left > vreal<Real>(Real(0)));
        }
        return blocked & ~bright;
    }

    /// Resets the share of some lanes to the whole light.
    void brighten(int first, std::uint32_t lanes_of)
    {
        const vreal<Real> one(Real(1));
        for (Real(&channel)[bundle_rays] : this->share)
            store(channel + first, select(from_bits<Real>(lanes_of), one, load(channel + first)));
    }

    Vec3v<Real> shares(int first) const
    {
        return {load(this->share[0] + first), load(this->share[1] + first),
                load(this->share[2] + first)};
    }
};

/// The scene that shadow rays are traced in.
template <class Real>
inline const abi::SceneView<Real>& casters_of(const abi::SceneView<Real>& scene)
{
    return scene.casters != nullptr ? *scene.casters : scene;
}

/// The inputs and outputs of shading a chunk of hits.
template <abi::Features F, class Real>
struct ShadeContext {
    const abi::SceneView<Real>* scene;
    const LightObjects<F, Real>* occluders;  ///< per light
    /// The surfaces at the hits, by packet; null if shading computes them itself.
    const SurfacePacket<Real>* surfaces;
    /// Per light, the shadows at the hits, see has_shadows(); null without a BVH.
    const LightShadows<F, Real>* shadows;
    int depth;  ///< number of reflections and refractions before these hits
    abi::RayCounts* counts;
    /// By pixel, an upper bound of the light that it lacks for rays that were not traced, in
    /// abi::lack_unit; null if all are traced.
    double* lacks;

    /// Whether the shadows of a light are already known.
    bool has_shadows(int light) const
    {
        return shadows != nullptr && !occluders[light].are_all;
    }

    bool spawns() const
    {
        return depth < scene->rules.max_depth;
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
