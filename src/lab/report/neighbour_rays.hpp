#pragma once

#include <vector>

#include <packtrace/intersect.hpp>
#include <packtrace/scene.hpp>

namespace packtrace {

/// A ray's first hit as the scalar reference has it in double, and those of rays close by.
class NeighbourRays {
public:
    explicit NeighbourRays(const Scene& scene);

    struct FirstHit {
        int object = -1;
        double t = 0.0;       ///< in lengths of the direction; t_max for a miss
        bool stable = false;  ///< all rays close by meet the same object
    };

    /// Directions close by differ by a ten-thousandth of the direction's length.
    [[nodiscard]] FirstHit trace(const Vec3& org, const Vec3& dir, double t_min,
                                 double t_max) const;

private:
    RayScene<double> rays_;
};

}  // namespace packtrace
