#pragma once

#include <packtrace/export.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>  // so that callers can catch the exceptions
#include <type_traits>

// The caller's own rays and their hits, in the layouts that RayScene accepts.
namespace packtrace {

/// Rays as arrays of their components, `count` elements each. Nothing is copied or kept.
///
/// A hit must have t_min < t < t_max; t_min >= 0. Directions need not be unit: t is in units of
/// their length. A ray with a NaN hits nothing. Origins must be within ±1e150 (±1e18 in single
/// precision with Accuracy::fast). The largest component of a direction must be between 1e-100 and
/// 1e100 (1e-12 and 1e12 in single precision). The answers for other rays are meaningless.
template <class Real>
struct RaysView {
    const Real* org_x = nullptr;
    const Real* org_y = nullptr;
    const Real* org_z = nullptr;
    const Real* dir_x = nullptr;
    const Real* dir_y = nullptr;
    const Real* dir_z = nullptr;
    const Real* t_min = nullptr;
    const Real* t_max = nullptr;
    std::size_t count = 0;
};

/// The surface number of a ray that starts on no surface, and of a miss.
inline constexpr std::int32_t no_start = std::numeric_limits<std::int32_t>::min();

/// The output arrays of closest hits, one element per ray. The arrays of normals may be null.
template <class Real>
struct HitsView {
    Real* t = nullptr;               ///< of a miss: the ray's t_max
    std::int32_t* object = nullptr;  ///< index in Scene::objects; -1 for a miss
    Real* normal_x = nullptr;        ///< unit, outwards
    Real* normal_y = nullptr;
    Real* normal_z = nullptr;
    // The arrays below may be null. Points and starts need the arrays of normals. The scalar kernel
    // fills none of them.
    /// Origins for rays that leave the hit on the outer or the inner side of the surface. With
    /// SelfHits::exact such a ray does not hit the point it starts at, at any t > 0. With
    /// SelfHits::note they are the hit point. NaN for a miss.
    Real* outer_start[3] = {};
    Real* inner_start[3] = {};
    Real* point[3] = {};              ///< the hit point; NaN for a miss
    std::int32_t* surface = nullptr;  ///< number of the surface for StartsView; no_start for a miss
};

/// The surfaces that rays start on, for rays that leave earlier hits; `count` elements each. With
/// SelfHits::exact such a ray hits its surface again only at a true second hit, however shallow its
/// way below the surface. `point` and `surface` come from HitsView. A ray that leaves on the inner
/// side of the surface has the complement ~surface. A ray that starts on no surface has `no_start`.
/// Numbers that no surface of the scene has are rejected; numbers from another scene cannot be
/// recognised.
template <class Real>
struct StartsView {
    const Real* point[3] = {};
    const std::int32_t* surface = nullptr;
};

/// Points of earlier hits, `count` elements each; `point` and `surface` come from HitsView. A point
/// on no surface has a negative surface number; if no point is on a surface, `surface` may be null.
template <class Real>
struct PointsView {
    const Real* point[3] = {};
    const std::int32_t* surface = nullptr;
    std::size_t count = 0;
};

/// One hit of a ray with a surface.
template <class Real>
struct SurfaceHit {
    Real t = 0;
    std::int32_t object = -1;  ///< index in Scene::objects; -1 for a miss, whose `t` is t_max
    Real normal[3] = {};       ///< unit, outwards
};

/// Bounds of the t of a hit in exact arithmetic: low <= t <= high. Empty (low > high) for no hit.
struct HitBounds {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    [[nodiscard]] bool empty() const
    {
        return low > high;
    }
};

/// One ray, with the ranges of RaysView.
template <class Real>
struct Ray {
    Real org[3] = {};
    Real dir[3] = {0, 0, 1};
    Real t_min = 0;
    Real t_max = std::numeric_limits<Real>::infinity();
};

/// Rays as an array of structs, or as members of your own structs, with `stride` bytes from one ray
/// to the next: RayStructs<float>(&mine[0].ray, mine.size(), sizeof mine[0]). Nothing is kept.
template <class Real>
struct RayStructs {
    const Ray<Real>* first = nullptr;
    std::size_t count = 0;
    std::size_t stride = sizeof(Ray<Real>);  ///< bytes, a multiple of alignof(Real)

    RayStructs(const Ray<Real>* rays, std::size_t ray_count,
               std::size_t ray_stride = sizeof(Ray<Real>))
        : first(rays), count(ray_count), stride(ray_stride)
    {
    }
    /// From a std::vector, std::array or std::span.
    template <class Rays>
    requires std::is_convertible_v<const Rays&, std::span<const Ray<Real>>> RayStructs(
        const Rays& rays)
        : first(std::span<const Ray<Real>>(rays).data()),
          count(std::span<const Ray<Real>>(rays).size())
    {
    }

    [[nodiscard]] const Ray<Real>& operator[](std::size_t i) const
    {
        return *reinterpret_cast<const Ray<Real>*>(reinterpret_cast<const std::byte*>(first) +
                                                   i * stride);
    }
};

/// The output of closest hits for RayStructs, with the same layouts.
template <class Real>
struct HitStructs {
    SurfaceHit<Real>* first = nullptr;
    std::size_t count = 0;
    std::size_t stride = sizeof(SurfaceHit<Real>);  ///< bytes

    HitStructs(SurfaceHit<Real>* hits, std::size_t hit_count,
               std::size_t hit_stride = sizeof(SurfaceHit<Real>))
        : first(hits), count(hit_count), stride(hit_stride)
    {
    }
    template <class Hits>
    requires std::is_convertible_v<Hits&, std::span<SurfaceHit<Real>>> HitStructs(Hits& hits)
        : first(std::span<SurfaceHit<Real>>(hits).data()),
          count(std::span<SurfaceHit<Real>>(hits).size())
    {
    }

    [[nodiscard]] SurfaceHit<Real>& operator[](std::size_t i) const
    {
        return *reinterpret_cast<SurfaceHit<Real>*>(reinterpret_cast<std::byte*>(first) +
                                                    i * stride);
    }
};

namespace detail {

/// Throws std::invalid_argument unless an array has `wanted` elements. It is in the library, so
/// that the headers compile with exceptions switched off.
PACKTRACE_API void check_length(const char* name, std::size_t length, std::size_t wanted);

}  // namespace detail

/// Makes a RaysView from spans (or vectors, or arrays) and checks their lengths.
template <class Real>
struct RaySpans {
    std::span<const Real> org_x, org_y, org_z;
    std::span<const Real> dir_x, dir_y, dir_z;
    std::span<const Real> t_min, t_max;

    /// Valid as long as the arrays. Throws std::invalid_argument unless all have one length.
    [[nodiscard]] RaysView<Real> view() const
    {
        const std::size_t count = org_x.size();
        detail::check_length("org_y", org_y.size(), count);
        detail::check_length("org_z", org_z.size(), count);
        detail::check_length("dir_x", dir_x.size(), count);
        detail::check_length("dir_y", dir_y.size(), count);
        detail::check_length("dir_z", dir_z.size(), count);
        detail::check_length("t_min", t_min.size(), count);
        detail::check_length("t_max", t_max.size(), count);
        return {org_x.data(), org_y.data(), org_z.data(), dir_x.data(), dir_y.data(),
                dir_z.data(), t_min.data(), t_max.data(), count};
    }
};

/// Makes a HitsView from spans. The spans of normals may be empty.
template <class Real>
struct HitSpans {
    std::span<Real> t;
    std::span<std::int32_t> object;
    std::span<Real> normal_x = {}, normal_y = {}, normal_z = {};

    /// Throws std::invalid_argument unless all arrays have `rays` elements.
    [[nodiscard]] HitsView<Real> view(std::size_t rays) const
    {
        detail::check_length("t", t.size(), rays);
        detail::check_length("object", object.size(), rays);
        HitsView<Real> hits;
        hits.t = t.data();
        hits.object = object.data();
        if (normal_x.empty() && normal_y.empty() && normal_z.empty())
            return hits;
        detail::check_length("normal_x", normal_x.size(), rays);
        detail::check_length("normal_y", normal_y.size(), rays);
        detail::check_length("normal_z", normal_z.size(), rays);
        hits.normal_x = normal_x.data();
        hits.normal_y = normal_y.data();
        hits.normal_z = normal_z.data();
        return hits;
    }
};

}  // namespace packtrace
