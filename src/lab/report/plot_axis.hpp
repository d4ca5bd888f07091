#pragma once

#include <string>
#include <vector>

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

/// With tics at decades. Zeros among the values lie two decades below the least other.
[[nodiscard]] PlotAxis decade_axis(const std::vector<double>& values);

}  // namespace packtrace
