#pragma once

#include <string>

#include <packtrace/image.hpp>

namespace packtrace {

/// The picture over a bar with the colours of color_ramp.hpp from end to end, and below it what
/// the ends stand for. Texts are of digits and the characters of "e.+-ns".
[[nodiscard]] Image<float> with_legend(const Image<float>& picture, const std::string& low,
                                       const std::string& high);

}  // namespace packtrace
