#pragma once

#include "reference/cut_rays.hpp"
#include "reference/world.hpp"

#include <algorithm>

namespace packtrace::reference {

/// What the colour along a ray is multiplied by on its way to the eye.
template <class Real>
struct RayWeight {
    Color<Real> share{1, 1, 1};
    CutCounter* cuts = nullptr;  ///< where rays that are not traced are recorded, if anywhere

    /// The weight of a child whose colour the ray multiplies by `factor`.
    [[nodiscard]] RayWeight of_child(const Color<Real>& factor) const
    {
        return {share * factor, cuts};
    }
};

/// Not in the notes: whether a ray of this weight and generation is left out, as
/// Scene::min_weight asks. It then brings nothing.
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
