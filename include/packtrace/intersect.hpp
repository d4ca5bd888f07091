#pragma once

#include <packtrace/export.hpp>
#include <packtrace/rays.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>
#include <packtrace/stop.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace packtrace {

/// What RayScene::update() did.
struct SceneUpdate {
    /// True: everything was rebuilt. False: the bvh was refitted, so that its boxes contain the
    /// moved objects.
    bool rebuilt = false;
    /// The expected number of boxes that a random line enters, relative to the bvh when it was
    /// built.
    double cost = 1.0;
};

/// A scene prepared for queries with the caller's own rays, by the packet kernels or the scalar
/// reference. `Real` is float or double. All const members may be called from several threads at
/// once. `closest_hits` and `occluded` do not allocate with the packet kernels. `watch` reports
/// progress and can stop a query, which then throws StopError.
template <class Real>
class RayScene {
public:
    /// Uses the options `kernel`, `isa`, `width`, `accuracy`, `self_hits` and `traversal`. Throws
    /// as render() does.
    PACKTRACE_API explicit RayScene(const Scene& scene, const RenderOptions& options = {});
    PACKTRACE_API ~RayScene();
    PACKTRACE_API RayScene(RayScene&&) noexcept;
    PACKTRACE_API RayScene& operator=(RayScene&&) noexcept;

    /// Moves objects: reads their surfaces and their Object::transform from `scene`. `scene` must
    /// have the objects that this RayScene was made of, in the same order. `moved` has the indices
    /// of the objects that may have moved; without it, all may have. Afterwards all answers equal
    /// those of a new RayScene of `scene`, bit for bit, except that the lights and the flags
    /// `casts_shadow` do not change.
    ///
    /// The bvh is refitted, which is several times as fast as a new build. It is rebuilt instead
    /// - by the first update, which also stores what later updates need, some 100 bytes an object;
    /// - if the kind of an object's surface changes;
    /// - if a moved object was or is too large for the bvh, as planes are;
    /// - if the cost of the refitted bvh exceeds 1.5;
    /// - if there is no bvh: for few objects, and with the scalar kernel.
    ///
    /// Uses the threads of the TBB arena of the caller. No other member may run at the same time.
    /// Throws SceneError as validate() does, and std::invalid_argument for a different number of
    /// objects or an index that no object has; the answers are then the same as before the call.
    PACKTRACE_API SceneUpdate update(const Scene& scene, std::span<const std::int32_t> moved);
    PACKTRACE_API SceneUpdate update(const Scene& scene);

    // Rays as arrays of their components. All throw std::invalid_argument if an array that is read
    // or written is null, unless there are no rays.

    /// Finds the closest hit of each ray; at equal t, the hit of the object with the lower index.
    PACKTRACE_API void closest_hits(const RaysView<Real>& rays, const HitsView<Real>& hits,
                                    const QueryWatch& watch = {}) const;

    /// Finds the closest hits of rays that leave earlier hits, from HitsView's outer_start or
    /// inner_start. `starts` has no effect with SelfHits::note and with the scalar kernel. Throws
    /// std::invalid_argument for a surface number that the scene does not have.
    PACKTRACE_API void closest_hits(const RaysView<Real>& rays, const StartsView<Real>& starts,
                                    const HitsView<Real>& hits, const QueryWatch& watch = {}) const;

    /// Sets mask[i] to 1 if ray i hits any object, otherwise to 0.
    PACKTRACE_API void occluded(const RaysView<Real>& rays, std::uint8_t* mask,
                                const QueryWatch& watch = {}) const;

    /// Sets mask[i] to 1 if the light with index `light` in Scene::lights reaches point i, else to
    /// 0. Every object between them that casts a shadow is an occluder, even a transparent one.
    ///
    /// Points on surfaces are treated as in pictures: the equation of their own object decides
    /// whether that object occludes them, and they do not occlude themselves. With SelfHits::note
    /// and with the scalar kernel, all points are treated as points that are on no surface. A point
    /// with a NaN is not lit.
    ///
    /// In a bvh of spheres, in single precision with Accuracy::exact, a light that is used often
    /// gets a light buffer (Haines and Greenberg 1986). Then lit() is faster than occluded() with
    /// rays to the light, and has the same answers. Runs on the calling thread, except for the
    /// preparations of a first call.
    ///
    /// Throws std::invalid_argument if there is no such light, for an ambient light, which has no
    /// direction, and for a surface number that the scene does not have.
    PACKTRACE_API void lit(const PointsView<Real>& points, std::size_t light, std::uint8_t* mask,
                           const QueryWatch& watch = {}) const;

    /// Finds all hits of each ray. `take` is called once per ray, in order. Hits are sorted by t in
    /// double precision, then by object. A ray that touches a surface without crossing it may hit
    /// it twice at the same t.
    using TakeHits = std::function<void(std::size_t ray, std::span<const SurfaceHit<Real>> hits)>;
    PACKTRACE_API void all_hits(const RaysView<Real>& rays, const TakeHits& take,
                                const QueryWatch& watch = {}) const;

    /// Writes proven bounds of the t of a hit to bounds[i]: the first hit of ray i with the object
    /// object[i] in the ray interval. The bounds are an empty interval if object[i] is -1, or if
    /// the ray certainly misses that object. `object` is the output of closest_hits(). The computed
    /// t is not used, and neither are the kernels.
    ///
    /// The bounds hold for the hit in exact arithmetic, with the ray's numbers as given in `Real`
    /// and the doubles in Scene::objects. Usually they are at most one last place of double apart.
    /// They are wider, up to the whole ray interval, if the ray only touches the object or hits it
    /// at its rim. Takes some 10 µs per ray. Throws std::invalid_argument for an index that no
    /// object has.
    PACKTRACE_API void bound_closest_hits(const RaysView<Real>& rays, const std::int32_t* object,
                                          HitBounds* bounds, const QueryWatch& watch = {}) const;

    /// Writes bounds of all hits of the ray with index `ray`: bounds[i] belongs to hits[i]. `hits`
    /// is the output of all_hits(). Hits of one object with equal t are matched in order. Throws
    /// std::invalid_argument unless `bounds` is as long as `hits`, if there is no such ray, and for
    /// an index that no object has.
    PACKTRACE_API void bound_all_hits(const RaysView<Real>& rays, std::size_t ray,
                                      std::span<const SurfaceHit<Real>> hits,
                                      std::span<HitBounds> bounds) const;

    // Rays as structs: the answers equal those for arrays, bit for bit. All throw
    // std::invalid_argument if there is not one place for the answer of each ray, and for null
    // pointers.

    /// The normal of a miss is (0, 0, 0).
    PACKTRACE_API void closest_hits(const RayStructs<Real>& rays, const HitStructs<Real>& hits,
                                    const QueryWatch& watch = {}) const;
    PACKTRACE_API void occluded(const RayStructs<Real>& rays, std::span<std::uint8_t> mask,
                                const QueryWatch& watch = {}) const;
    PACKTRACE_API void all_hits(const RayStructs<Real>& rays, const TakeHits& take,
                                const QueryWatch& watch = {}) const;
    /// bounds[i] belongs to object[i], as above.
    PACKTRACE_API void bound_closest_hits(const RayStructs<Real>& rays,
                                          std::span<const std::int32_t> object,
                                          std::span<HitBounds> bounds,
                                          const QueryWatch& watch = {}) const;

    // One ray. Queries of many rays are several times as fast per ray.

    [[nodiscard]] PACKTRACE_API SurfaceHit<Real> closest_hit(const Ray<Real>& ray) const;
    [[nodiscard]] PACKTRACE_API bool occluded(const Ray<Real>& ray) const;
    [[nodiscard]] PACKTRACE_API std::vector<SurfaceHit<Real>> all_hits(const Ray<Real>& ray) const;
    [[nodiscard]] PACKTRACE_API HitBounds bound_closest_hit(const Ray<Real>& ray,
                                                            std::int32_t object) const;
    /// One interval for each of `hits`, which is the output of all_hits() for this ray.
    [[nodiscard]] PACKTRACE_API std::vector<HitBounds> bound_all_hits(
        const Ray<Real>& ray, std::span<const SurfaceHit<Real>> hits) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace packtrace
