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

/// Rays as arrays of their components. Camera rays are in rows of tiles and, in each tile, along a
/// Z-order curve: 4, 8 or 16 consecutive rays are a block of 2x2, 4x2 or 4x4 pixels. Secondary rays
/// are in the order of their camera rays, without those of misses.
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
    /// Replaces these rays by `count` rays of `others`.
    void copy(const RaySet& others, std::size_t first, std::size_t count);
};

/// The answers to a RaySet: `occluded` of any-hit queries, the others of closest-hit queries.
struct Hits {
    std::vector<float> t;
    std::vector<std::int32_t> object;  ///< -1 for a miss
    std::vector<std::uint8_t> occluded;

    explicit Hits(std::size_t size) : t(size), object(size, -1), occluded(size)
    {
    }
};

/// A point on a sphere of the scene.
struct SurfacePoint {
    Vec3 position;
    Vec3 normal;
    double offset = 0.0;  ///< distance of ray origins from the surface
};

/// The scene's camera rays, one for each pixel. Width and height must be multiples of tile_size.
[[nodiscard]] RaySet camera_rays(const Scene& scene);

/// The hit points of rays, moved onto the true surface in double precision; none for misses.
[[nodiscard]] std::vector<SurfacePoint> hit_points(const Scene& scene, const RaySet& rays,
                                                   const Hits& hits);

/// The end at which shadow rays start.
enum class ShadowEnd { surface, light };

/// Segments between points and a light.
[[nodiscard]] RaySet shadow_rays(const std::vector<SurfacePoint>& points, const Vec3& light,
                                 ShadowEnd start);

/// One ray from each point, with a random direction in proportion to the cosine to the normal.
[[nodiscard]] RaySet bounce_rays(const std::vector<SurfacePoint>& points);

/// The first t at which a ray enters or leaves a sphere within its interval, in double precision;
/// infinity for a miss.
[[nodiscard]] double true_distance(const RaySet& rays, std::size_t ray, const Sphere& sphere);

}  // namespace packtrace::peers
