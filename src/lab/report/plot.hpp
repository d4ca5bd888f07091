#pragma once

#include <cstddef>
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
    double y = 0.0;  ///< >= 0; zeros lie on a line of their own below the others
    std::string label;
    double low = 0.0;  ///< a bar from here to `high`, of which `x` is the middle
    double high = 0.0;
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    bool line = false;  ///< through its points, which have neither labels nor bars then
};

struct Plot {
    std::string title;
    std::string x_title;
    std::string y_title;
    std::vector<PlotSeries> series;
};

/// A double-logarithmic plot as SVG, drawn by gnuplot, whose labels do not lie on each other.
/// gnuplot numbers what it draws as groups gnuplot_plot_1 …: one for a line; for other series its
/// points, the lines to their labels, and the labels. Throws PlotError.
[[nodiscard]] std::string draw_svg(const Plot& plot);

/// How many of these groups a series takes.
[[nodiscard]] inline int groups_of(const PlotSeries& series)
{
    return series.line ? 1 : 3;
}

/// The colour that a plot draws its series of an index in, as #rrggbb.
[[nodiscard]] const char* series_color(std::size_t series);

/// Throws the PlotError that draw_svg would throw for want of gnuplot.
void check_plots();

}  // namespace packtrace
