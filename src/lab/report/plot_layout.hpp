#pragma once

#include <string>
#include <vector>

// Where the axes and the labels of a plot lie.
namespace packtrace {

/// A logarithmic axis of a plot, with the pixels it lies on.
struct PlotAxis {
    struct Tic {
        double value = 0.0;
        std::string name;
    };

    double low = 0.1;  ///< at its first pixel
    double high = 1.0;
    std::vector<Tic> tics;

    double first_pixel = 0.0;
    double last_pixel = 0.0;

    [[nodiscard]] double pixel(double value) const;
    [[nodiscard]] double value(double pixel) const;
};

/// With tics at 1, 2 and 5 of every decade, and some room on both sides. `values` are > 0.
[[nodiscard]] PlotAxis fine_axis(const std::vector<double>& values);

/// With tics at decades. Zeros among the values lie two decades below the least other, infinite
/// ones as far above the largest.
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

/// A point of a plot that has something to be written beside it.
struct LabelledPoint {
    double x = 0.0;
    double y = 0.0;
    std::string label;
    /// A bar through the point, if it is longer than the point's dot.
    double bar_left = x;
    double bar_right = x;
};

/// Where the labels go, in the order of the points: into `area`, beside their points or further
/// off, so that none lies on another, nor on a point or its bar, as long as there is room.
/// Characters are taken as `letter` wide, lines as `line` high.
[[nodiscard]] std::vector<PixelBox> place_labels(const std::vector<LabelledPoint>& points,
                                                 const PixelBox& area, double letter, double line);

}  // namespace packtrace
