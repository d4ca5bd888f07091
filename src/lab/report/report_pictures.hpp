#pragma once

#include <cstddef>
#include <string>

#include <packtrace/report.hpp>

// The pictures of a report and their heat maps, by their index in StudyReport::pictures.
namespace packtrace {

/// What a reader calls it: "truth", or the run that gave it and how many others did, too.
[[nodiscard]] std::string picture_label(const StudyReport& study, std::size_t picture);

/// The largest finite error of a pixel against the truth, which white stands for in its heat map.
[[nodiscard]] double largest_error(const StudyReport& study, std::size_t picture);

/// What black stands for where white is `largest`: any error as small, or none.
[[nodiscard]] double least_error_shown(double largest);

/// Its heat map, without a legend.
[[nodiscard]] Image<float> error_map(const StudyReport& study, std::size_t picture);

/// Its heat map as a picture of its own, over a legend.
[[nodiscard]] Image<float> error_map_with_legend(const StudyReport& study, std::size_t picture);

}  // namespace packtrace
