#include "lab/report/label_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace packtrace {
namespace {

// Half the edge of what a point's dot takes, and what lies between it and its label.
constexpr double dot_radius = 5.0;
constexpr double label_gap = 3.0;
// Half the height of a bar's ends.
constexpr double bar_radius = 3.0;
// How many lines further up or down a label may stand.
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

// Places for a label, the best first: right, left, then ever more lines up and down.
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
    // From the left, as their labels go to the right.
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
