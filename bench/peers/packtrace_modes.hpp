#pragma once

#include "tracer.hpp"
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <string>
#include <vector>

namespace packtrace::peers {

/// An instruction set and an accuracy, and their name in tables.
struct PacktraceMode {
    std::string name;
    std::string isa;
    Accuracy accuracy;
};

/// packtrace in each mode: its public ray interface, and tiles of camera rays, which it makes
/// itself.
[[nodiscard]] std::vector<Tracer> packtrace_tracers(const Scene& scene,
                                                    const std::vector<PacktraceMode>& modes);

}  // namespace packtrace::peers
