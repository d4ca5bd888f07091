#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/light_shadows.hpp"
#include "kernels/object_sets.hpp"
#include "kernels/surface.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// Where the shadow rays of a scene find what is in their way.
template <class Real>
inline const abi::SceneView<Real>& casters_of(const abi::SceneView<Real>& scene)
{
    return scene.casters != nullptr ? *scene.casters : scene;
}

/// What shading a tile needs besides the hits themselves.
template <abi::Features F, class Real>
struct ShadeContext {
    const abi::SceneView<Real>* scene;
    const LightObjects<F, Real>* blockers;  ///< for each light
    /// The surfaces at the hits, by packet; null where shading alone looks at them.
    const SurfacePacket<Real>* surfaces;
    /// For each light, what the hits see of it; null where packets find out by themselves.
    const LightShadows<F, Real>* shadows;
    int depth;  ///< reflections and refractions before these hits
    abi::RayCounts* counts;

    bool spawns() const
    {
        return depth < scene->max_depth;
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
