#pragma once

#include <array>
#include <vector>

#include <packtrace/intersect.hpp>

#include "lab/truth/wide_truth.hpp"

namespace packtrace::lab {

/// Rays as the arrays that RayScene takes.
template <class Real>
class RayColumns {
public:
    explicit RayColumns(const std::vector<StressRay>& rays)
    {
        for (const StressRay& ray : rays) {
            const double values[8] = {ray.org.x, ray.org.y, ray.org.z, ray.dir.x,
                                      ray.dir.y, ray.dir.z, ray.t_min, ray.t_max};
            for (std::size_t i = 0; i < 8; ++i)
                columns_[i].push_back(static_cast<Real>(values[i]));
        }
    }

    [[nodiscard]] RaysView<Real> view() const
    {
        const auto& c = columns_;
        return {c[0].data(), c[1].data(), c[2].data(), c[3].data(), c[4].data(),
                c[5].data(), c[6].data(), c[7].data(), c[0].size()};
    }

private:
    std::array<std::vector<Real>, 8> columns_;
};

}  // namespace packtrace::lab
