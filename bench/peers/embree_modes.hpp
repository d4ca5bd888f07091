#pragma once

#include "embree_scene.hpp"
#include "tracer.hpp"

#include <memory>
#include <vector>

namespace packtrace::peers {

/// Which of Embree's modes are raced: all, or those that win most often.
enum class Modes { all, quick };

/// Embree's modes of tracing rays through one scene: single rays, packets of 4, 8 and 16, streams
/// of single rays, of packets and of arrays; each flagged coherent and incoherent.
[[nodiscard]] std::vector<Tracer> embree_tracers(const std::shared_ptr<const EmbreeScene>& scene,
                                                 Geometry geometry, Modes which);

}  // namespace packtrace::peers
