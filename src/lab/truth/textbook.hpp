#pragma once

#include "lab/truth/wide_truth.hpp"

#include <array>
#include <limits>
#include <vector>

namespace packtrace::lab {

template <class Real>
struct TextbookBody {
    Real own[3][4] = {};  ///< world to own space
    Real coefficient[10] = {};
    Real low = -std::numeric_limits<Real>::infinity();
    Real high = std::numeric_limits<Real>::infinity();
    bool capped = false;
    std::vector<std::array<Real, 3>> corners;  ///< of a polygon, own space; a pair is an edge
};

/// The formulas of an introductory textbook: b² - 4 a c, (-b ± √D) / 2a, and a matrix's inverse
/// applied to points. For comparison only.
template <class Real>
class TextbookScene {
public:
    explicit TextbookScene(const Scene& scene);

    [[nodiscard]] Answer closest_hit(const StressRay& ray) const;

private:
    std::vector<TextbookBody<Real>> bodies_;
};

}  // namespace packtrace::lab
