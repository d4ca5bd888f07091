#pragma once

#include "geometry/object_rules.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/shapes.hpp"
#include <packtrace/scene.hpp>

#include <glm/geometric.hpp>

#include <type_traits>

// Spheres. A large sphere whose surface passes near the world's origin, such as a ground, is stored
// as an anchored sphere, because its curvature there is more exact than its centre.
namespace packtrace {

struct SurfaceLists;

struct LoweredSphere {
    static constexpr abi::SurfaceKind kind = abi::SurfaceKind::sphere;
    static constexpr auto shapes = &abi::ShapesView::spheres;

    Vec3 center{0.0};
    double radius = 1.0;
    std::int32_t surface = 0;
};

/// A sphere for which kernels use the curvature at `anchor` in place of the centre. The anchor is
/// the point of its surface nearest to the world's origin.
struct LoweredAnchoredSphere {
    static constexpr abi::SurfaceKind kind = abi::SurfaceKind::anchored_sphere;
    static constexpr auto shapes = &abi::ShapesView::anchored_spheres;

    Vec3 center{0.0};
    double radius = 1.0;
    Vec3 anchor{0.0};
    std::int32_t surface = 0;
};

/// Either kind of sphere.
template <class Kind>
concept AnySphere =
    std::is_same_v<Kind, LoweredSphere> || std::is_same_v<Kind, LoweredAnchoredSphere>;

/// Appends the sphere in world space to the list of its kind: under a similarity it stays a sphere,
/// otherwise it becomes a quadric. Returns the number of surface numbers that it takes.
int lower_kind(const Object& object, const Sphere& sphere, std::int32_t surface,
               SurfaceLists& lists);

/// Appends the sphere under a similarity. Returns false for other transforms.
bool lower_sphere(const Sphere& sphere, const Mat4& transform, std::int32_t surface,
                  SurfaceLists& lists);

/// Whether a sphere is stored as an anchored sphere: its surface passes near the world's origin,
/// relative to its size.
[[nodiscard]] bool is_anchored(const LoweredSphere& sphere);

/// Moves the spheres with is_anchored() to the list of anchored spheres, and finds their anchors.
void part_anchored_spheres(SurfaceLists& lists);

template <AnySphere Kind>
[[nodiscard]] Exit exit_of(const Kind& sphere, const Vec3& eye, const Vec3& forward)
{
    const Vec3 o = eye - sphere.center;
    const double c = glm::dot(o, o) - sphere.radius * sphere.radius;
    if (!(c < 0.0))
        return std::nullopt;
    return first_positive_root(glm::dot(forward, forward), glm::dot(o, forward), c);
}

template <AnySphere Kind>
[[nodiscard]] auto key_of(const Kind& sphere)
{
    return std::tuple_cat(key_of(sphere.center), std::tuple(sphere.radius));
}

template <AnySphere Kind>
[[nodiscard]] bool is_certifiable(const Kind& sphere)
{
    return is_certifiable(sphere.center, sphere.radius);
}

[[nodiscard]] inline CenteredBox box_of(const LoweredSphere& sphere)
{
    return {sphere.center, Vec3(sphere.radius)};
}

[[nodiscard]] abi::SphereShape shape_of(const LoweredSphere& sphere);

/// A bound of the distance by which rounding to Real moves a sphere's centre.
template <class Real>
[[nodiscard]] double center_error(const LoweredSphere& sphere);

template <class Real>
[[nodiscard]] abi::AnchoredSphere<Real> pack(const LoweredAnchoredSphere& sphere);

}  // namespace packtrace
