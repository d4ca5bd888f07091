#include "lab/report/plot.hpp"

#include "core/run_filter.hpp"
#include "core/text.hpp"
#include "lab/report/plot_layout.hpp"
#include "scene/language/quote.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace packtrace {
namespace {

// The picture and the area inside the axes, in pixels.
constexpr double plot_width = 900.0;
constexpr double plot_height = 560.0;
constexpr PixelBox inside_axes{78.0, 46.0, 690.0, 494.0};
// Width of a letter and height of a line of labels, in pixels.
constexpr double label_letter = 6.4;
constexpr double label_line = 14.0;

// A string of gnuplot between single quotes. It is escaped, because a line end would begin another
// command.
std::string quoted(const std::string& text)
{
    return "'" + replaced(language::escape(text), '\'', "''") + "'";
}

std::string number_text(double value)
{
    return brief(value, 9);
}

struct Axes {
    PlotAxis x;
    PlotAxis y;
};

Axes axes_of(const Plot& plot)
{
    std::vector<double> x;
    std::vector<double> y;
    for (const PlotSeries& series : plot.series)
        for (const PlotPoint& point : series.points) {
            x.push_back(point.x);
            y.push_back(point.y);
            if (!series.line) {
                x.push_back(point.low);
                x.push_back(point.high);
            }
        }
    Axes axes{fine_axis(x), decade_axis(y)};
    axes.x.first_pixel = inside_axes.left;
    axes.x.last_pixel = inside_axes.right;
    axes.y.first_pixel = inside_axes.bottom;
    axes.y.last_pixel = inside_axes.top;
    return axes;
}

// The labels of all series together, in their order. Lines have none.
std::vector<PixelBox> label_places(const Plot& plot, const Axes& axes)
{
    std::vector<LabelledPoint> points;
    for (const PlotSeries& series : plot.series)
        if (!series.line)
            for (const PlotPoint& point : series.points)
                points.push_back({axes.x.pixel(point.x), axes.y.pixel(point.y), point.label,
                                  axes.x.pixel(point.low), axes.x.pixel(point.high)});
    return place_labels(points, inside_axes, label_letter, label_line);
}

void write_block(std::ostream& to, const std::string& name, const std::string& rows)
{
    to << '$' << name << " << END_OF_ROWS\n" << rows << "END_OF_ROWS\n";
}

// A row of gnuplot's data.
std::string row_of(double x, double y, const std::string& more = "")
{
    return number_text(x) + " " + number_text(y) + more + "\n";
}

// Writes the points of each series, the lines from them to their labels, and the labels.
void write_data(std::ostream& to, const Plot& plot, const Axes& axes)
{
    const std::vector<PixelBox> places = label_places(plot, axes);
    std::size_t next = 0;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        std::string points, leaders, labels;
        for (const PlotPoint& point : plot.series[i].points) {
            const double y = std::clamp(point.y, axes.y.low, axes.y.high);
            points +=
                row_of(point.x, y, " " + number_text(point.low) + " " + number_text(point.high));
            if (plot.series[i].line)
                continue;
            const PixelBox& box = places[next++];
            const double middle = axes.y.value((box.top + box.bottom) / 2);
            const bool is_left = box.right < axes.x.pixel(point.x);
            // A label right beside its point needs no line.
            const bool is_beside = std::abs((box.top + box.bottom) / 2 - axes.y.pixel(point.y)) < 1;
            const double end = is_left ? box.right : box.left;
            leaders += row_of(point.x, y) +
                       (is_beside ? row_of(point.x, y) : row_of(axes.x.value(end), middle)) + "\n";
            labels += row_of(axes.x.value(box.left), middle, " \"" + point.label + "\"");
        }
        const std::string series_number = std::to_string(i);
        write_block(to, "points" + series_number, points);
        if (!plot.series[i].line) {
            write_block(to, "leaders" + series_number, leaders);
            write_block(to, "labels" + series_number, labels);
        }
    }
}

std::string tics_text(const PlotAxis& axis)
{
    std::string text = "(";
    for (const PlotAxis::Tic& tic : axis.tics)
        text += (text.size() > 1 ? ", " : "") + quoted(tic.name) + " " + number_text(tic.value);
    return text + ")";
}

void write_frame(std::ostream& to, const Plot& plot, const Axes& axes)
{
    to << "set terminal svg size " << plot_width << ',' << plot_height
       << " dynamic noenhanced font 'sans-serif,13' background '#ffffff'\n"
          "set encoding utf8\nset logscale xy\nset grid lc rgb '#dddddd' lt 1\n"
          "set key at screen 0.785,0.92 left top Left reverse samplen 2\n"
       << "set lmargin at screen " << inside_axes.left / plot_width << "\nset rmargin at screen "
       << inside_axes.right / plot_width << "\nset tmargin at screen "
       << 1.0 - inside_axes.top / plot_height << "\nset bmargin at screen "
       << 1.0 - inside_axes.bottom / plot_height << "\nset xrange [" << number_text(axes.x.low)
       << ':' << number_text(axes.x.high) << "]\nset yrange [" << number_text(axes.y.low) << ':'
       << number_text(axes.y.high) << "]\nset xtics " << tics_text(axes.x) << "\nset ytics "
       << tics_text(axes.y) << "\nset title " << quoted(plot.title) << "\nset xlabel "
       << quoted(plot.x_title) << "\nset ylabel " << quoted(plot.y_title) << " offset 1,0\n";
}

void write_series(std::ostream& to, const PlotSeries& series, std::size_t index)
{
    const std::string color = std::string(" lc rgb '") + series_color(index) + "'";
    if (series.line) {
        to << "$points" << index << " using 1:2 with lines lw 2" << color << " title "
           << quoted(series.name);
        return;
    }
    to << "$points" << index << " using 1:2:3:4 with xerrorbars pt 7 ps 0.8" << color << " title "
       << quoted(series.name) << ", $leaders" << index
       << " using 1:2 with lines lw 0.7 lc rgb '#999999' notitle, $labels" << index
       << " using 1:2:3 with labels left font ',11' textcolor rgb '" << series_color(index)
       << "' notitle";
}

std::string script_of(const Plot& plot)
{
    const Axes axes = axes_of(plot);
    std::ostringstream script;
    write_frame(script, plot, axes);
    write_data(script, plot, axes);
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        script << (i == 0 ? "plot " : ", ");
        write_series(script, plot.series[i], i);
    }
    script << '\n';
    return script.str();
}

/// The last line of gnuplot's error output for a script, for messages.
std::string complaint_of(const std::string& script)
{
    std::string said = run_filter({"gnuplot"}, script, STDERR_FILENO).output;
    while (!said.empty() && (said.back() == '\n' || said.back() == ' '))
        said.pop_back();
    const std::string line = said.substr(said.rfind('\n') + 1);
    return (line.empty() ? "" : " (" + line + ")") + "; is there room for temporary files?";
}

}  // namespace

const char* series_color(std::size_t series)
{
    // Colour-blind people can tell these colours apart, too.
    static constexpr std::array<const char*, 6> colors{"#888888", "#009e73", "#d55e00",
                                                       "#0072b2", "#000000", "#a03080"};
    return colors[series % colors.size()];
}

void check_plots()
{
    const FilterResult version = run_filter({"gnuplot", "--version"}, "");
    if (!version.started || version.exit_code != 0)
        throw PlotError(
            "gnuplot draws the plots and can't be run; "
            "install it: apt-get install gnuplot-nox");
}

std::string draw_svg(const Plot& plot)
{
    const std::string script = script_of(plot);
    const FilterResult drawn = run_filter({"gnuplot"}, script);
    if (!drawn.started)
        check_plots();
    if (drawn.exit_code != 0 || drawn.output.find("</svg>") == std::string::npos)
        throw PlotError("gnuplot could not draw '" + plot.title + "'" + complaint_of(script));
    return drawn.output;
}

}  // namespace packtrace
