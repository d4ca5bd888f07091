#pragma once

#include "lower/packed_light_buffers.hpp"
#include "lower/packed_scene.hpp"

#include <vector>

namespace packtrace {

/// From how many camera rays on light buffers pay for being built, in frames with mirrored or
/// refracted rays (`bounces`) or without; infinite where lights can't have buffers.
template <class Real>
[[nodiscard]] double camera_rays_for_buffers(const PackedScene<Real>& scene, bool bounces);

/// A packed scene in which each light that casts shadows has a buffer, a view of the BVH from the
/// light. Shadow rays that are spread look up their occluders there, in single precision and exact
/// mode.
template <class Real>
class BufferedScene {
public:
    /// Builds the buffers on the threads of the TBB arena of the caller. `scene` must outlive this.
    explicit BufferedScene(const PackedScene<Real>& scene);
    BufferedScene(const BufferedScene&) = delete;
    BufferedScene& operator=(const BufferedScene&) = delete;

    /// Valid as long as this object.
    [[nodiscard]] const abi::SceneView<Real>& view() const
    {
        return view_;
    }

    /// Memory besides that of the scene.
    [[nodiscard]] std::size_t bytes() const;

private:
    std::vector<PackedLightBuffer> buffers_;  // by light
    AlignedArray<abi::LightBuffer> buffer_views_;
    abi::SceneView<Real> casters_;  // used where some objects cast no shadow
    abi::SceneView<Real> view_;
};

}  // namespace packtrace
