#pragma once

#include <packtrace/render.hpp>
#include <packtrace/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace packtrace::reference {

/// Counts the rays that are not traced, and bounds what a pixel lacks for them: camera ray by
/// camera ray, the largest sum counts. For one thread.
class CutCounter {
public:
    /// `most_light` is what a ray can bring, by its generation.
    explicit CutCounter(const std::vector<Rgb>& most_light) : most_light_(most_light)
    {
    }

    void begin_camera_ray()
    {
        lacks_ = 0.0;
    }

    void add(const Rgb& weight, int generation)
    {
        const Rgb& most = most_light_[static_cast<std::size_t>(generation)];
        double lacking = 0.0;
        for (int channel = 0; channel < 3; ++channel)
            lacking = std::max(lacking, std::abs(weight[channel]) * most[channel]);
        lacks_ += std::ceil(lacking / unit);
        ++total_.rays;
        total_.bound = std::max(total_.bound, lacks_ * unit);
    }

    /// Takes over what another thread has counted.
    void add(const CutCounter& more)
    {
        total_.rays += more.total_.rays;
        total_.bound = std::max(total_.bound, more.total_.bound);
    }

    /// The same for another thread, from nothing on.
    [[nodiscard]] CutCounter fresh() const
    {
        return CutCounter(most_light_);
    }

    [[nodiscard]] const CutRays& total() const
    {
        return total_;
    }

private:
    // As the packets count (abi::lack_unit): sums of whole numbers do not depend on their order.
    static constexpr double unit = 0x1p-40;

    const std::vector<Rgb>& most_light_;
    double lacks_ = 0.0;  // of the present camera ray, in units
    CutRays total_;
};

}  // namespace packtrace::reference
