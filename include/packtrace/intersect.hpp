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
    /// Whether all was built anew. Else the hierarchy was refitted: its boxes follow the objects.
    bool rebuilt = false;
    /// How many boxes a random line enters, against the hierarchy when it was built.
    double cost = 1.0;
};

/// A scene made ready for rays of the caller's own, by the packet kernels or the scalar
/// reference. `Real` is float or double. All const members may be called from several threads at
/// once; `closest_hits` and `occluded` allocate nothing with the packet kernels. `watch` reports
/// progress and can stop a query, which then throws StopError.
template <class Real>
class RayScene {
public:
    /// Of the options `kernel`, `isa`, `width`, `accuracy`, `self_hits` and `traversal` count.
    /// Throws as render() does.
    PACKTRACE_API explicit RayScene(const Scene& scene, const RenderOptions& options = {});
    PACKTRACE_API ~RayScene();
    PACKTRACE_API RayScene(RayScene&&) noexcept;
    PACKTRACE_API RayScene& operator=(RayScene&&) noexcept;

    /// Takes over where objects of `scene` are now: the numbers of their surfaces, and
    /// Object::transform. It has the objects, in their order, that this was made of; `moved` are
    /// the numbers of those that may have moved, all without it. The answers are from then on those
    /// of a RayScene made of `scene`, bit for bit; but lights, and what casts shadows, stay those
    /// that this was made of.
    ///
    /// The hierarchy is refitted, several times as quickly as one is built. It is built anew by the
    /// first update (which keeps what later ones need, some 100 bytes an object), where objects
    /// become another kind of surface or were or are too large for it (such as planes), where its
    /// cost has grown to 1.5, and always where there is none (few objects, the scalar kernel).
    ///
    /// Works on the threads of the TBB arena the call runs in; no other member may run meanwhile.
    /// Throws SceneError as validate() does, std::invalid_argument for another number of objects
    /// and for numbers that no object has; then the answers stay those of before.
    PACKTRACE_API SceneUpdate update(const Scene& scene, std::span<const std::int32_t> moved);
    PACKTRACE_API SceneUpdate update(const Scene& scene);

    // Rays as arrays of their components. All throw std::invalid_argument where an array that is
    // read or written is null, unless there are no rays.

    /// The first hit of each ray; at equal t that of the lower object number.
    PACKTRACE_API void closest_hits(const RaysView<Real>& rays, const HitsView<Real>& hits,
                                    const QueryWatch& watch = {}) const;

    /// The same of rays that leave earlier hits, from HitsView's outer_start or inner_start. With
    /// SelfHits::note, and the scalar kernel, `starts` changes nothing. Throws
    /// std::invalid_argument for a number that no surface has.
    PACKTRACE_API void closest_hits(const RaysView<Real>& rays, const StartsView<Real>& starts,
                                    const HitsView<Real>& hits, const QueryWatch& watch = {}) const;

    /// mask[i] becomes 1 where ray i hits anything, else 0.
    PACKTRACE_API void occluded(const RaysView<Real>& rays, std::uint8_t* mask,
                                const QueryWatch& watch = {}) const;

    /// mask[i] becomes 1 where the light of number `light` in Scene::lights reaches point i, else
    /// 0: nothing that casts a shadow is in the way, transparent or not. Points on surfaces are
    /// taken as pictures take them: whether their own object keeps the light from them follows from
    /// its equation, and they are no occluders of themselves. In a hierarchy of spheres, in single
    /// precision with Accuracy::exact, a light asked for often gets a light buffer (Haines and
    /// Greenberg 1986): then this is quicker than occluded() with rays to the light, with the same
    /// answers. A point with a NaN is not lit. Works on the calling thread, but for what a first
    /// call prepares. With SelfHits::note, and the scalar kernel, all points are from elsewhere.
    /// Throws std::invalid_argument where there is no such light, or it is ambient and has no way
    /// that something could be in, and for a number that no surface has.
    PACKTRACE_API void lit(const PointsView<Real>& points, std::size_t light, std::uint8_t* mask,
                           const QueryWatch& watch = {}) const;

    /// Every hit of each ray, sorted by t as double has it, then object; `take` is called once a
    /// ray, in order. A ray that touches a surface without crossing it may hit it twice at the
    /// same t.
    using TakeHits = std::function<void(std::size_t ray, std::span<const SurfaceHit<Real>> hits)>;
    PACKTRACE_API void all_hits(const RaysView<Real>& rays, const TakeHits& take,
                                const QueryWatch& watch = {}) const;

    /// bounds[i] gets proven bounds of the t at which ray i first hits the object of number
    /// object[i] between its t_min and t_max; an empty interval where object[i] is -1, or where the
    /// ray surely hits that object nowhere there. `object` is what closest_hits() gave; its t is
    /// not looked at, and no kernel takes part. "First hits" means what infinite precision makes of
    /// the ray's numbers as given in `Real` and of the doubles in Scene::objects. Bounds are rarely
    /// more than a last place of double apart, but where the ray only touches the object, or
    /// hits it at its rim, up to all of its range. Takes some 10 µs a ray. Throws
    /// std::invalid_argument for a number that no object has.
    PACKTRACE_API void bound_closest_hits(const RaysView<Real>& rays, const std::int32_t* object,
                                          HitBounds* bounds, const QueryWatch& watch = {}) const;

    /// The same of all hits of ray number `ray`, which all_hits() gave: bounds[i] is that of
    /// hits[i]. Where single precision or double does not tell two hits of an object apart, they
    /// are taken in order. `bounds` is as long as `hits`; std::invalid_argument else, and for a
    /// number that no object has.
    PACKTRACE_API void bound_all_hits(const RaysView<Real>& rays, std::size_t ray,
                                      std::span<const SurfaceHit<Real>> hits,
                                      std::span<HitBounds> bounds) const;

    // Rays as structs: the answers are those of the same rays in arrays, bit for bit. All throw
    // std::invalid_argument where there is not one answer for each ray, and for null pointers.

    /// The normal of a miss is (0, 0, 0).
    PACKTRACE_API void closest_hits(const RayStructs<Real>& rays, const HitStructs<Real>& hits,
                                    const QueryWatch& watch = {}) const;
    PACKTRACE_API void occluded(const RayStructs<Real>& rays, std::span<std::uint8_t> mask,
                                const QueryWatch& watch = {}) const;
    PACKTRACE_API void all_hits(const RayStructs<Real>& rays, const TakeHits& take,
                                const QueryWatch& watch = {}) const;
    /// bounds[i] is that of object[i], as above.
    PACKTRACE_API void bound_closest_hits(const RayStructs<Real>& rays,
                                          std::span<const std::int32_t> object,
                                          std::span<HitBounds> bounds,
                                          const QueryWatch& watch = {}) const;

    // One ray. Many at a time are several times as quick.

    [[nodiscard]] PACKTRACE_API SurfaceHit<Real> closest_hit(const Ray<Real>& ray) const;
    [[nodiscard]] PACKTRACE_API bool occluded(const Ray<Real>& ray) const;
    [[nodiscard]] PACKTRACE_API std::vector<SurfaceHit<Real>> all_hits(const Ray<Real>& ray) const;
    [[nodiscard]] PACKTRACE_API HitBounds bound_closest_hit(const Ray<Real>& ray,
                                                            std::int32_t object) const;
    /// As many as `hits`, which all_hits() gave for this ray.
    [[nodiscard]] PACKTRACE_API std::vector<HitBounds> bound_all_hits(
        const Ray<Real>& ray, std::span<const SurfaceHit<Real>> hits) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace packtrace
