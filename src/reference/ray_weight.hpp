#pragma once

#include "core/cut_rays.hpp"
#include "reference/world.hpp"
#include <packtrace/render.hpp>
#include <packtrace/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

// The weights of rays, and the rays that are not traced because their weight is too small.
namespace packtrace::reference {

/// Counts the rays that are not traced, and bounds the light that a pixel lacks: the largest sum of
/// any one camera ray. For one thread.
class CutCounter {
public:
    /// `most_light` is the largest light that a ray can bring, by generation.
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

    /// Adds the counts of another thread.
    void add(const CutCounter& more)
    {
        total_ += more.total_;
    }

    /// An empty counter for another thread.
    [[nodiscard]] CutCounter fresh() const
    {
        return CutCounter(most_light_);
    }

    [[nodiscard]] const CutRays& total() const
    {
        return total_;
    }

private:
    // As in the kernels (abi::lack_unit): sums of whole numbers do not depend on their order.
    static constexpr double unit = 0x1p-40;

    const std::vector<Rgb>& most_light_;
    double lacks_ = 0.0;  // by the current camera ray, in units
    CutRays total_;
};

/// The factor from the colour along a ray to its part of the pixel.
template <class Real>
struct RayWeight {
    Color<Real> share{1, 1, 1};
    CutCounter* cuts = nullptr;  ///< counts the rays that are not traced; may be null

    /// The weight of a child whose colour the ray multiplies by `factor`.
    [[nodiscard]] RayWeight of_child(const Color<Real>& factor) const
    {
        return {share * factor, cuts};
    }
};

/// Not in the notes: whether a ray of this weight and generation is not traced because of
/// Scene::min_weight. It then brings no light.
template <class Real>
[[nodiscard]] bool is_cut(const World<Real>& world, const RayWeight<Real>& weight, int generation)
{
    const Color<Real>& share = weight.share;
    if (world.min_weight <= 0 || std::max({share.x, share.y, share.z}) >= world.min_weight)
        return false;
    if (weight.cuts != nullptr)
        weight.cuts->add({static_cast<double>(share.x), static_cast<double>(share.y),
                          static_cast<double>(share.z)},
                         generation);
    return true;
}

}  // namespace packtrace::reference
