#pragma once

#include <string>
#include <vector>

#include <packtrace/render.hpp>

namespace packtrace::lab {

/// How many threads make some of the pictures.
inline constexpr int soak_threads = 3;

/// A way to trace rays: precision and options.
struct SoakWay {
    std::string precision = "single";  ///< single, double, extended (scalar kernel only)
    RenderOptions options;
};

/// The options of `packtrace render` that ask for it; those of `packtrace intersect`, where the
/// answer is to be to rays.
[[nodiscard]] std::string render_words(const SoakWay& way);
[[nodiscard]] std::string intersect_words(const SoakWay& way);

/// The scalar kernel.
[[nodiscard]] SoakWay scalar_way(const std::string& precision, SelfHits self_hits);

/// Ways that must give the same bits.
struct SoakGroup {
    std::vector<SoakWay> ways;  ///< the first is the plainest
};

/// Packets of one precision and accuracy through every instruction set here, list and hierarchy,
/// special and general kernel, one thread and several: sets with fused multiply-add in one group,
/// each other one in its own.
[[nodiscard]] std::vector<SoakGroup> packet_groups(const std::string& precision, Accuracy accuracy,
                                                   SelfHits self_hits);

}  // namespace packtrace::lab
