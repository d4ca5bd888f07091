#pragma once

#include <vector>

#include <packtrace/scene.hpp>

#include "tracer.hpp"

namespace packtrace::peers {

/// packtrace's public ray interface for each of the instruction sets, and its tiles of camera
/// rays, which it makes itself.
[[nodiscard]] std::vector<Tracer> packtrace_tracers(const Scene& scene,
                                                    const std::vector<std::string>& isas);

}  // namespace packtrace::peers
