#pragma once

#include "geometry/object_rules.hpp"
#include "kernel_abi/lists.hpp"
#include "kernel_abi/shapes.hpp"
#include <packtrace/scene.hpp>

#include <glm/geometric.hpp>

#include <type_traits>

// Spheres. One whose surface passes so near the world's origin for its size that its curvature
// there is more exact than its centre, such as a ground, is stored as an anchored sphere.
namespace packtrace {

struct SurfaceLists;

struct LoweredSphere {
    static constexpr abi::SurfaceKind kind = abi::SurfaceKind::sphere;
    static constexpr auto shapes = &abi::ShapesView::spheres;

    Vec3 center{0.0};
    double radius = 1.0;
    std::int32_t surface = 0;
};

/// A sphere of which kernels use the curvature at `anchor`, the point of its surface nearest the
/// world's origin, in place of its centre.
struct LoweredAnchoredSphere {
    static constexpr abi::SurfaceKind kind = abi::SurfaceKind::anchored_sphere;
    static constexpr auto shapes = &abi::ShapesView::anchored_spheres;

    Vec3 center{0.0};
    double radius = 1.0;
    Vec3 anchor{0.0};
    std::int32_t surface = 0;
};

/// Either kind.
template <class Kind>
concept AnySphere =
    std::is_same_v<Kind, LoweredSphere> || std::is_same_v<Kind, LoweredAnchoredSphere>;

/// Appends the sphere to the list of what it is in world space; returns how many surface numbers it
/// takes. Under a similarity it stays a sphere, else it becomes a quadric.
int lower_kind(const Object& object, const Sphere& sphere, std::int32_t surface,
               SurfaceLists& lists);

/// Appends the sphere under a similarity; false under any other transform.
bool lower_sphere(const Sphere& sphere, const Mat4& transform, std::int32_t surface,
                  SurfaceLists& lists);

/// Whether a sphere's surface passes so near the world's origin for its size that it is stored as
/// an anchored one.
[[nodiscard]] bool is_anchored(const LoweredSphere& sphere);

/// Moves the large spheres whose surface passes near the world's origin for their size to a list of
/// their own, and finds their anchors.
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

/// How far rounding to Real moves a sphere's centre, at most.
template <class Real>
[[nodiscard]] double center_error(const LoweredSphere& sphere);

template <class Real>
[[nodiscard]] abi::AnchoredSphere<Real> pack(const LoweredAnchoredSphere& sphere);

}  // namespace packtrace
