#include "lab/report/plot_layout.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numeric>

namespace packtrace {
namespace {

constexpr int most_decade_tics = 8;

// Room at both ends of a fine axis: at least this factor, or this power of the axis' range.
constexpr double least_room = 1.3;
constexpr double room_power = 0.1;

// Axes with a larger range have tics at decades only.
constexpr double fine_range = 300.0;

// Room at both ends of a decade axis, in decades; and the decades to the line of zeros or
// infinities.
constexpr double decade_room = 0.2;
constexpr int decades_to_special = 2;

std::string tic_text(const char* format, double value)
{
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

double power_of_ten(int exponent)
{
    return std::pow(10.0, exponent);
}

}  // namespace

double PlotAxis::pixel(double value) const
{
    return first_pixel + (last_pixel - first_pixel) * std::log(std::clamp(value, low, high) / low) /
                             std::log(high / low);
}

double PlotAxis::value(double pixel) const
{
    return low * std::pow(high / low, (pixel - first_pixel) / (last_pixel - first_pixel));
}

PlotAxis fine_axis(const std::vector<double>& values)
{
    PlotAxis axis;
    const double least = *std::min_element(values.begin(), values.end());
    const double most = *std::max_element(values.begin(), values.end());
    const double room = std::max(least_room, std::pow(most / least, room_power));
    axis.low = least / room;
    axis.high = most * room;
    const bool wide = axis.high / axis.low > fine_range;
    for (int exponent = static_cast<int>(std::floor(std::log10(axis.low)));
         power_of_ten(exponent) <= axis.high; ++exponent)
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * power_of_ten(exponent);
            if (value >= axis.low && value <= axis.high && (digit == 1.0 || !wide))
                axis.tics.push_back({value, tic_text("%g", value)});
        }
    return axis;
}

PlotAxis decade_axis(const std::vector<double>& values)
{
    double least = 1.0;
    double most = 0.0;
    bool has_zero = false;
    bool has_infinity = false;
    for (const double value : values) {
        has_zero = has_zero || value == 0.0;
        has_infinity = has_infinity || std::isinf(value);
        if (value > 0.0 && std::isfinite(value)) {
            least = most > 0.0 ? std::min(least, value) : value;
            most = std::max(most, value);
        }
    }
    if (most == 0.0)
        most = least;
    const int lowest = static_cast<int>(std::floor(std::log10(least) - decade_room));
    const int highest = static_cast<int>(std::ceil(std::log10(most) + decade_room));
    PlotAxis axis;
    axis.low = power_of_ten(has_zero ? lowest - decades_to_special : lowest);
    axis.high = power_of_ten(has_infinity ? highest + decades_to_special : highest);
    if (has_zero)
        axis.tics.push_back({axis.low, "0"});
    const int step = (highest - lowest) / most_decade_tics + 1;
    for (int exponent = lowest; exponent <= highest; exponent += step)
        axis.tics.push_back({power_of_ten(exponent), tic_text("%.0e", power_of_ten(exponent))});
    if (has_infinity)
        axis.tics.push_back({axis.high, "inf"});
    return axis;
}

namespace {

// Half the edge of a point's dot, and the gap between it and its label, in pixels.
constexpr double dot_radius = 5.0;
constexpr double label_gap = 3.0;
// Half the height of a bar's ends, in pixels.
constexpr double bar_radius = 3.0;
// How many lines above or below its point a label may be.
constexpr int most_lines_off = 24;

PixelBox box_around(const LabelledPoint& point)
{
    return {point.x - dot_radius, point.y - dot_radius, point.x + dot_radius, point.y + dot_radius};
}

PixelBox bar_of(const LabelledPoint& point)
{
    return {point.bar_left, point.y - bar_radius, point.bar_right, point.y + bar_radius};
}

bool is_inside(const PixelBox& box, const PixelBox& area)
{
    return box.left >= area.left && box.right <= area.right && box.top >= area.top &&
           box.bottom <= area.bottom;
}

// Places for a label, the best first: right, left, then more and more lines up and down.
std::vector<PixelBox> candidate_places(const LabelledPoint& point, double width, double line)
{
    std::vector<PixelBox> boxes;
    const auto add = [&](double left, double middle) {
        boxes.push_back({left, middle - line / 2, left + width, middle + line / 2});
    };
    for (int lines = 0; lines <= most_lines_off; ++lines)
        for (const double way : {-1.0, 1.0}) {
            const double middle = point.y + way * lines * line;
            add(point.x + dot_radius + label_gap, middle);
            add(point.x - dot_radius - label_gap - width, middle);
            if (lines > 0)
                add(point.x - width / 2, middle);
        }
    return boxes;
}

}  // namespace

std::vector<PixelBox> place_labels(const std::vector<LabelledPoint>& points, const PixelBox& area,
                                   double letter, double line)
{
    std::vector<PixelBox> taken;
    for (const LabelledPoint& point : points)
        for (const PixelBox& box : {box_around(point), bar_of(point)})
            taken.push_back(box);
    // From left to right, as labels prefer the right side.
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return points[a].x < points[b].x; });
    std::vector<PixelBox> places(points.size());
    for (const std::size_t i : order) {
        const std::vector<PixelBox> boxes =
            candidate_places(points[i], letter * static_cast<double>(points[i].label.size()), line);
        const auto is_free = [&](const PixelBox& box) {
            return is_inside(box, area) &&
                   std::none_of(taken.begin(), taken.end(),
                                [&](const PixelBox& other) { return overlap(box, other); });
        };
        const auto found = std::find_if(boxes.begin(), boxes.end(), is_free);
        places[i] = found != boxes.end() ? *found : boxes.front();
        taken.push_back(places[i]);
    }
    return places;
}

}  // namespace packtrace
