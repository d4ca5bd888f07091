#pragma once

#include "scene/moved_shape.hpp"
#include <packtrace/intersect.hpp>

#include <memory>

namespace packtrace {

/// What answers a RayScene's questions.
template <class Real>
class RayBackend {
public:
    virtual ~RayBackend() = default;
    /// `starts` is null for rays from anywhere.
    virtual void closest_hits(const RaysView<Real>& rays, const StartsView<Real>* starts,
                              const HitsView<Real>& hits) const = 0;
    virtual void occluded(const RaysView<Real>& rays, std::uint8_t* mask) const = 0;
    /// `light` is the number among those of the scene that are not ambient.
    virtual void lit(const PointsView<Real>& points, std::size_t light,
                     std::uint8_t* mask) const = 0;
    virtual void all_hits(const RaysView<Real>& rays,
                          const typename RayScene<Real>::TakeHits& take) const = 0;
    /// As RayScene::update; `moved` are objects of the scene, each there once, without a fault.
    virtual SceneUpdate update(const Scene& scene, std::span<const MovedShape> moved) = 0;
};

template <class Real>
[[nodiscard]] std::unique_ptr<RayBackend<Real>> packet_backend(const Scene& scene,
                                                               const RenderOptions& options);

template <class Real>
[[nodiscard]] std::unique_ptr<RayBackend<Real>> scalar_backend(const Scene& scene);

}  // namespace packtrace
