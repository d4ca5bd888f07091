#pragma once

#include "lower/packed_light_buffers.hpp"
#include "lower/packed_scene.hpp"

#include <vector>

namespace packtrace {

/// After how many camera rays lights' own views of a scene pay for themselves in frames whose rays
/// go on from surfaces (`bounces`) or don't; infinite where lights can't have any.
template <class Real>
[[nodiscard]] double camera_rays_for_buffers(const PackedScene<Real>& scene, bool bounces);

/// A packed scene whose lights that cast shadows have their own views of a hierarchy of spheres,
/// where shadow rays that share no way are looked for in single precision and exact mode.
template <class Real>
class BufferedScene {
public:
    /// Makes the views on the threads of the TBB arena the call runs in. `scene` outlives this.
    explicit BufferedScene(const PackedScene<Real>& scene);
    BufferedScene(const BufferedScene&) = delete;
    BufferedScene& operator=(const BufferedScene&) = delete;

    /// Valid as long as this object.
    [[nodiscard]] const abi::SceneView<Real>& view() const
    {
        return view_;
    }

    /// Held besides the scene.
    [[nodiscard]] std::size_t bytes() const;

private:
    std::vector<PackedLightBuffer> buffers_;  // by light
    AlignedArray<abi::LightBuffer> buffer_views_;
    abi::SceneView<Real> casters_;  // where some objects cast no shadow
    abi::SceneView<Real> view_;
};

}  // namespace packtrace
