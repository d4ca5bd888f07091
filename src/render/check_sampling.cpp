#include "render/check_sampling.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace packtrace {

const RenderOptions& checked_sampling(const RenderOptions& options)
{
    if (options.samples < 1 || options.samples > most_samples)
        throw std::invalid_argument("samples: " + std::to_string(options.samples) +
                                    " a pixel; choose from 1 to " + std::to_string(most_samples));
    if (!options.adaptive)
        return options;
    if (!(*options.adaptive >= 0.0) || !std::isfinite(*options.adaptive))
        throw std::invalid_argument("adaptive: the contrast is a finite number >= 0");
    if (options.samples == 1)
        throw std::invalid_argument("adaptive: needs more than one sample a pixel");
    return options;
}

}  // namespace packtrace
