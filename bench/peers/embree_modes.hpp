#pragma once

#include "embree_scene.hpp"
#include "tracer.hpp"

#include <memory>
#include <vector>

namespace packtrace::peers {

/// Every way of Embree's to trace rays through one scene: single rays, packets of 4, 8 and 16,
/// streams of single rays, of packets and of arrays; each flagged coherent and incoherent.
/// `quick`: those that win most often.
[[nodiscard]] std::vector<Tracer> embree_tracers(const std::shared_ptr<const EmbreeScene>& scene,
                                                 Geometry geometry, bool quick);

}  // namespace packtrace::peers
