#include "study/plot.hpp"

#include <cstdio>
#include <sstream>

#include "core/run_filter.hpp"

namespace packtrace {
namespace {

// As a string of gnuplot's between single quotes.
std::string quoted(const std::string& text)
{
    std::string result = "'";
    for (const char c : text)
        result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

void write_data(std::ostream& to, const Plot& plot)
{
    char numbers[64];
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        to << "$series" << i << " << END_OF_SERIES\n";
        for (const PlotPoint& point : plot.series[i].points) {
            std::snprintf(numbers, sizeof numbers, "%.9g %.9g ", point.x, point.y);
            to << numbers << '"' << point.label << "\"\n";
        }
        to << "END_OF_SERIES\n";
    }
}

std::string script_of(const Plot& plot)
{
    std::ostringstream script;
    script << "set terminal svg size 860,560 dynamic noenhanced font 'sans-serif,12' "
              "background '#ffffff'\n"
              "set encoding utf8\nset logscale xy\nset grid\nset key outside right top\n"
              "set format y '%.0e'\nset format x '%g'\nset offsets graph 0.05, graph 0.15, graph "
              "0.05, graph 0.05\n"
           << "set title " << quoted(plot.title) << "\nset xlabel " << quoted(plot.x_title)
           << "\nset ylabel " << quoted(plot.y_title) << '\n';
    write_data(script, plot);
    script << "plot ";
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const PlotSeries& series = plot.series[i];
        script << (i > 0 ? ", " : "") << "$series" << i << " using 1:2 with "
               << (series.line ? "lines lw 2 lc rgb '#888888'" : "points ps 1 pt 7") << " title "
               << quoted(series.name);
        if (!series.line)
            script << ", $series" << i
                   << " using 1:2:3 with labels left offset 0.6,0.4 font ',8' notitle";
    }
    script << '\n';
    return script.str();
}

}  // namespace

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
    const FilterResult drawn = run_filter({"gnuplot"}, script_of(plot));
    if (!drawn.started)
        check_plots();
    if (drawn.exit_code != 0 || drawn.output.find("</svg>") == std::string::npos)
        throw PlotError("gnuplot could not draw '" + plot.title + "'");
    return drawn.output;
}

}  // namespace packtrace
