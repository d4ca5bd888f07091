#pragma once

#include <packtrace/intersect.hpp>
#include <packtrace/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace packtrace::peers {

/// Edge of a tile, pixels.
inline constexpr int tile_size = 16;
inline constexpr std::size_t tile_pixels = tile_size * tile_size;

/// Rays as arrays of their components. Camera rays go tile by tile, row by row of tiles, and
/// along a Z-order curve in each: 4, 8 or 16 consecutive ones are a 2x2, 4x2 or 4x4 block.
/// Secondary rays keep the order of the camera rays they come from, misses left out.
struct RaySet {
    std::vector<float> org[3];
    std::vector<float> dir[3];
    std::vector<float> t_min;
    std::vector<float> t_max;

    [[nodiscard]] std::size_t size() const
    {
        return t_min.size();
    }
    void add(const Vec3& origin, const Vec3& direction, double longest);
    [[nodiscard]] RaysView<float> view(std::size_t first, std::size_t count) const;
    /// Replaces these rays by some of others.
    void copy(const RaySet& others, std::size_t first, std::size_t count);
};

/// What a pass over a RaySet found; `occluded` for any hit, the others for the closest.
struct Hits {
    std::vector<float> t;
    std::vector<std::int32_t> object;  ///< -1 for a miss
    std::vector<std::uint8_t> occluded;

    explicit Hits(std::size_t size) : t(size), object(size, -1), occluded(size)
    {
    }
};

/// A point on a sphere of the scene, and which.
struct SurfacePoint {
    Vec3 position;
    Vec3 normal;
    double offset = 0.0;  ///< how far above the surface rays start
};

/// The scene's camera rays, one a pixel. Width and height must be multiples of tile_size.
[[nodiscard]] RaySet camera_rays(const Scene& scene);

/// Where rays hit, taken to the true surface in double precision; misses are left out.
[[nodiscard]] std::vector<SurfacePoint> hit_points(const Scene& scene, const RaySet& rays,
                                                   const Hits& hits);

/// Segments between points and a light, from the point or, `from_light`, from the other end.
enum class ShadowEnd { surface, light };
[[nodiscard]] RaySet shadow_rays(const std::vector<SurfacePoint>& points, const Vec3& light,
                                 ShadowEnd start);

/// One ray from each point, its direction spread by the cosine to the normal.
[[nodiscard]] RaySet bounce_rays(const std::vector<SurfacePoint>& points);

/// The distance at which a ray truly enters or leaves a sphere first within its limits, in
/// double precision; infinity for a miss.
[[nodiscard]] double true_distance(const RaySet& rays, std::size_t ray, const Sphere& sphere);

}  // namespace packtrace::peers
