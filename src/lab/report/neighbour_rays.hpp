#pragma once

#include <packtrace/intersect.hpp>
#include <packtrace/scene.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace packtrace {

/// The closest hits of a ray and of rays next to it, by the scalar reference in double.
class NeighbourRays {
public:
    explicit NeighbourRays(const Scene& scene) : rays_(scene, {.kernel = Kernel::scalar})
    {
    }

    struct FirstHit {
        int object = -1;
        double t = 0.0;       ///< in lengths of the direction; t_max for a miss
        bool stable = false;  ///< all neighbours hit the same object
    };

    [[nodiscard]] FirstHit trace(const Vec3& org, const Vec3& dir, double t_min, double t_max) const
    {
        std::array<Ray<double>, ray_count> rays;
        for (std::size_t ray = 0; ray < ray_count; ++ray) {
            const Vec3 way = moved(dir, ray);
            rays[ray] = {{org.x, org.y, org.z}, {way.x, way.y, way.z}, t_min, t_max};
        }
        std::array<SurfaceHit<double>, ray_count> hits;
        rays_.closest_hits(rays, hits);
        const SurfaceHit<double>& first = hits.front();
        const bool stable = std::all_of(
            hits.begin(), hits.end(), [&](const auto& hit) { return hit.object == first.object; });
        return {first.object, first.t, stable};
    }

private:
    // Neighbours' directions differ by this share of the direction's length.
    static constexpr double spread = 1e-4;
    // The ray itself, and two neighbours for each axis.
    static constexpr std::size_t ray_count = 7;

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
