#pragma once

#include "kernel_abi/kernel_table.hpp"
#include <packtrace/vec.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace packtrace {

/// Gathers the samples of single pixels of a tile, and renders as many at a time as a kernel takes:
/// `render(samples, rgb)`. A pixel's samples are added in the order of the pattern.
template <class Real>
class SampleBatch {
public:
    using Render = std::function<void(const abi::TileSamples<Real>& samples, Real* rgb)>;

    SampleBatch(const std::vector<Vec2>& pattern, Render render)
        : pattern_(pattern), render_(std::move(render))
    {
    }

    /// `pixel` has the mean of the samples after finish().
    void add_pixel(int column, int row, Real* pixel)
    {
        pixels_.push_back(pixel);
        pixel[0] = pixel[1] = pixel[2] = Real(0);
        for (const Vec2& place : pattern_) {
            samples_.column[samples_.count] =
                static_cast<Real>(column) + static_cast<Real>(place.x);
            samples_.row[samples_.count] = static_cast<Real>(row) + static_cast<Real>(place.y);
            to_[samples_.count++] = pixel;
            if (samples_.count == abi::tile_pixels)
                flush();
        }
    }

    void finish()
    {
        if (samples_.count > 0)
            flush();
        const Real share = Real(1) / static_cast<Real>(pattern_.size());
        for (Real* pixel : pixels_)
            for (int channel = 0; channel < 3; ++channel)
                pixel[channel] *= share;
    }

private:
    void flush()
    {
        render_(samples_, rgb_);
        for (int i = 0; i < samples_.count; ++i)
            for (int channel = 0; channel < 3; ++channel)
                to_[i][channel] += rgb_[3 * i + channel];
        samples_.count = 0;
    }

    const std::vector<Vec2>& pattern_;
    Render render_;
    abi::TileSamples<Real> samples_;
    Real rgb_[3 * abi::tile_pixels];
    Real* to_[abi::tile_pixels];
    std::vector<Real*> pixels_;
};

}  // namespace packtrace
