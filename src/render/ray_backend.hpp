#pragma once

#include "scene/moved_shape.hpp"
#include <packtrace/intersect.hpp>

#include <memory>

namespace packtrace {

/// The implementation of RayScene's queries: packets or the scalar reference.
template <class Real>
class RayBackend {
public:
    virtual ~RayBackend() = default;
    /// `starts` is null for rays that do not leave earlier hits.
    virtual void closest_hits(const RaysView<Real>& rays, const StartsView<Real>* starts,
                              const HitsView<Real>& hits) const = 0;
    virtual void occluded(const RaysView<Real>& rays, std::uint8_t* mask) const = 0;
    /// `light` is the index among the lights that are not ambient.
    virtual void lit(const PointsView<Real>& points, std::size_t light,
                     std::uint8_t* mask) const = 0;
    virtual void all_hits(const RaysView<Real>& rays,
                          const typename RayScene<Real>::TakeHits& take) const = 0;
    /// As RayScene::update(). `moved` has objects of the scene, without duplicates and faults.
    virtual SceneUpdate update(const Scene& scene, std::span<const MovedShape> moved) = 0;
};

template <class Real>
[[nodiscard]] std::unique_ptr<RayBackend<Real>> packet_backend(const Scene& scene,
                                                               const RenderOptions& options);

template <class Real>
[[nodiscard]] std::unique_ptr<RayBackend<Real>> scalar_backend(const Scene& scene);

}  // namespace packtrace
