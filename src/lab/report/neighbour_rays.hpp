#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <packtrace/intersect.hpp>
#include <packtrace/scene.hpp>

#include <glm/geometric.hpp>

namespace packtrace {

/// A ray's first hit as the scalar reference has it in double, and those of rays close by.
class NeighbourRays {
public:
    explicit NeighbourRays(const Scene& scene) : rays_(scene, scalar())
    {
    }

    struct FirstHit {
        int object = -1;
        double t = 0.0;       ///< in lengths of the direction; t_max for a miss
        bool stable = false;  ///< all rays close by meet the same object
    };

    /// Directions close by differ by a ten-thousandth of the direction's length.
    [[nodiscard]] FirstHit trace(const Vec3& org, const Vec3& dir, double t_min, double t_max) const
    {
        using Lane = std::array<double, ray_count>;
        std::array<Lane, 3> orgs{};
        std::array<Lane, 3> dirs{};
        Lane low{};
        Lane high{};
        for (std::size_t ray = 0; ray < ray_count; ++ray) {
            const Vec3 way = moved(dir, ray);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                orgs[axis][ray] = org[static_cast<int>(axis)];
                dirs[axis][ray] = way[static_cast<int>(axis)];
            }
            low[ray] = t_min;
            high[ray] = t_max;
        }
        Lane t{};
        std::array<std::int32_t, ray_count> object{};
        HitsView<double> hits;
        hits.t = t.data();
        hits.object = object.data();
        rays_.closest_hits({orgs[0].data(), orgs[1].data(), orgs[2].data(), dirs[0].data(),
                            dirs[1].data(), dirs[2].data(), low.data(), high.data(), ray_count},
                           hits);
        const bool stable = std::all_of(object.begin(), object.end(),
                                        [&](std::int32_t hit) { return hit == object.front(); });
        return {object.front(), t.front(), stable};
    }

private:
    static constexpr double spread = 1e-4;
    // The ray itself, and one to each side of each axis.
    static constexpr std::size_t ray_count = 7;

    static RenderOptions scalar()
    {
        RenderOptions options;
        options.kernel = Kernel::scalar;
        return options;
    }

    static Vec3 moved(const Vec3& dir, std::size_t ray)
    {
        Vec3 result = dir;
        if (ray > 0)
            result[static_cast<int>((ray - 1) / 2)] +=
                (ray % 2 != 0 ? spread : -spread) * length(dir);
        return result;
    }

    RayScene<double> rays_;
};

}  // namespace packtrace
