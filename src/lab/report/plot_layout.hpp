#pragma once

#include <string>
#include <vector>

// The layout of a plot: its axes and labels.
namespace packtrace {

/// A logarithmic axis of a plot, and its pixels.
struct PlotAxis {
    struct Tic {
        double value = 0.0;
        std::string name;
    };

    double low = 0.1;   ///< value at the first pixel
    double high = 1.0;  ///< value at the last pixel
    std::vector<Tic> tics;

    double first_pixel = 0.0;
    double last_pixel = 0.0;

    [[nodiscard]] double pixel(double value) const;
    [[nodiscard]] double value(double pixel) const;
};

/// An axis with tics at 1, 2 and 5 of every decade, and some room on both sides. `values` are > 0.
[[nodiscard]] PlotAxis fine_axis(const std::vector<double>& values);

/// An axis with tics at decades. Zeros lie two decades below the least other value, infinite values
/// two decades above the largest.
[[nodiscard]] PlotAxis decade_axis(const std::vector<double>& values);

/// A rectangle of a picture, in pixels to the right and down.
struct PixelBox {
    double left = 0.0;
    double top = 0.0;
    double right = 0.0;
    double bottom = 0.0;
};

[[nodiscard]] inline bool overlap(const PixelBox& a, const PixelBox& b)
{
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

/// A point of a plot with a label.
struct LabelledPoint {
    double x = 0.0;
    double y = 0.0;
    std::string label;
    /// A bar through the point, if it is longer than the point's dot.
    double bar_left = x;
    double bar_right = x;
};

/// The places of the labels, in the order of the points: inside `area`, beside their points or
/// further away. As long as there is room, no label overlaps another one, a point or a bar.
/// Characters count as `letter` wide, lines as `line` high.
[[nodiscard]] std::vector<PixelBox> place_labels(const std::vector<LabelledPoint>& points,
                                                 const PixelBox& area, double letter, double line);

}  // namespace packtrace
