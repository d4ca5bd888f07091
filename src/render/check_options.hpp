#pragma once

#include "core/check_number.hpp"
#include <packtrace/render.hpp>

#include <stdexcept>
#include <string>

namespace packtrace {

/// The largest number of samples per pixel.
inline constexpr int most_samples = 1024;

/// Throws std::invalid_argument for a value beyond `last`, the last one of its enumeration.
template <class Enumeration>
inline void check_enumeration(const std::string& option, Enumeration value, Enumeration last)
{
    check_number(option, static_cast<int>(value), 0, static_cast<int>(last));
}

/// Throws std::invalid_argument for options that only the packet kernel has.
inline void check_scalar(const RenderOptions& options)
{
    const char* const choice = options.isa != "auto"                       ? "isa"
                               : options.width != 0                        ? "lanes"
                               : options.traversal != Traversal::automatic ? "traversal"
                               : options.accuracy != Accuracy::exact       ? "fast accuracy"
                               : options.force_general                     ? "force_general"
                                                                           : nullptr;
    if (choice != nullptr)
        throw std::invalid_argument(std::string("the scalar kernel has no ") + choice +
                                    ", only packets do; leave it out or use the packet kernel");
}

/// Throws std::invalid_argument for invalid enumeration values, and for options that the chosen
/// kernel does not have.
inline void check_kernel(const RenderOptions& options)
{
    check_enumeration("kernel", options.kernel, Kernel::scalar);
    check_enumeration("accuracy", options.accuracy, Accuracy::exact);
    check_enumeration("self_hits", options.self_hits, SelfHits::exact);
    check_enumeration("traversal", options.traversal, Traversal::tree);
    if (options.kernel == Kernel::scalar)
        check_scalar(options);
}

/// Returns the options. Throws std::invalid_argument, with one line, for impossible ones.
inline RenderOptions checked_options(const RenderOptions& options)
{
    check_kernel(options);
    check_number("threads", options.threads, 0, most_threads);
    check_number("samples", options.samples, 1, most_samples);
    if (!options.adaptive)
        return options;
    check_not_negative("adaptive", *options.adaptive);
    if (options.samples == 1)
        throw std::invalid_argument("adaptive: needs more than one sample a pixel");
    return options;
}

/// The region to render. Throws std::invalid_argument for a region that is not inside the picture.
[[nodiscard]] inline Region checked_region(const RenderOptions& options, const Scene& scene)
{
    if (!options.region)
        return {0, 0, scene.width, scene.height};
    const Region& region = *options.region;
    const bool within = region.x >= 0 && region.y >= 0 && region.width >= 1 && region.height >= 1 &&
                        region.x < scene.width && region.y < scene.height &&
                        region.width <= scene.width - region.x &&
                        region.height <= scene.height - region.y;
    if (!within)
        throw std::invalid_argument(
            "region: " + std::to_string(region.width) + " x " + std::to_string(region.height) +
            " pixels from (" + std::to_string(region.x) + ", " + std::to_string(region.y) +
            ") on are not within the picture of " + std::to_string(scene.width) + " x " +
            std::to_string(scene.height) + "; stay inside it");
    return region;
}

}  // namespace packtrace
