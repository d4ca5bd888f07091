#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace packtrace {

/// gnuplot is missing or fails; `what()` is one line.
struct PlotError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct PlotPoint {
    double x = 0.0;  ///< > 0
    double y = 0.0;  ///< >= 0; zeros lie on a separate line below the others
    std::string label;
    double low = 0.0;  ///< a bar around `x` goes from here to `high`
    double high = 0.0;
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points = {};
    bool line = false;  ///< draws a line through the points, without labels and bars
};

struct Plot {
    std::string title;
    std::string x_title;
    std::string y_title;
    std::vector<PlotSeries> series;
};

/// A double-logarithmic plot as SVG, drawn by gnuplot, without overlapping labels. gnuplot numbers
/// the groups of the picture gnuplot_plot_1 …: one for a line; three for other series, with their
/// points, the lines to their labels, and the labels. Throws PlotError.
[[nodiscard]] std::string draw_svg(const Plot& plot);

/// The number of groups of a series.
[[nodiscard]] inline int groups_of(const PlotSeries& series)
{
    return series.line ? 1 : 3;
}

/// The colour of a plot's series number `series`, as #rrggbb.
[[nodiscard]] const char* series_color(std::size_t series);

/// Throws PlotError if gnuplot is missing.
void check_plots();

}  // namespace packtrace
