#pragma once

#include <vector>

#include "lab/harness/statistics.hpp"

namespace packtrace {

/// Times of a frame's pieces. The frame is the sum of each one's median: what a busy machine takes
/// from a piece now and then is not in it.
class PieceTimes {
public:
    explicit PieceTimes(int pieces) : seconds_(static_cast<std::size_t>(pieces))
    {
    }

    void add(int piece, double seconds)
    {
        seconds_[static_cast<std::size_t>(piece)].push_back(seconds);
    }

    /// Every piece was added at least once.
    [[nodiscard]] double frame() const
    {
        double sum = 0.0;
        for (const std::vector<double>& piece : seconds_)
            sum += median_of(piece);
        return sum;
    }

private:
    std::vector<std::vector<double>> seconds_;
};

}  // namespace packtrace
