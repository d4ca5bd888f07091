#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace packtrace {

/// gnuplot is missing or refuses; `what()` is one line.
struct PlotError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct PlotPoint {
    double x = 0.0;  ///< > 0
    double y = 0.0;  ///< > 0
    std::string label;
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    bool line = false;  ///< through its points
};

struct Plot {
    std::string title;
    std::string x_title;
    std::string y_title;
    std::vector<PlotSeries> series;
};

/// A double-logarithmic plot as SVG, drawn by gnuplot. Throws PlotError.
[[nodiscard]] std::string draw_svg(const Plot& plot);

/// Throws the PlotError that draw_svg would throw for want of gnuplot.
void check_plots();

}  // namespace packtrace
