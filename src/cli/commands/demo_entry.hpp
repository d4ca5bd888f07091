#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <packtrace/image.hpp>
#include <packtrace/scene.hpp>

namespace packtrace::cli {

/// One way to render the demonstration's scene, and what came of it.
struct DemoEntry {
    bool packet = false;
    bool single = false;  ///< precision; else double
    std::string isa;      ///< packets only
    int lanes = 1;
    int threads = 1;
    std::vector<double> seconds;  ///< one a round
    std::uint64_t rays = 0;       ///< of the packets' picture: camera, shadow and reflected
    Image<double> image;
};

/// The scalar reference, then every instruction set of this machine, in single and double on
/// one thread; then the widest single packets on `threads` when there are more than one.
[[nodiscard]] std::vector<DemoEntry> demo_entries(int threads);

/// Renders the scene once more and keeps the picture; the seconds it took.
[[nodiscard]] double render_entry(const Scene& scene, DemoEntry& entry);

}  // namespace packtrace::cli
