#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>

#include <packtrace/export.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

namespace packtrace {

/// Rays as arrays of their components, `count` elements each; nothing is copied or kept. A hit
/// counts where t_min < t < t_max; t_min >= 0. Directions need not be unit, t counts in their
/// lengths. A ray with a NaN anywhere hits nothing.
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

/// Where closest hits go: `object` is the index in Scene::objects, -1 for a miss, whose `t` is
/// the ray's t_max. Normals are unit and point outwards; leave them null where not wanted.
template <class Real>
struct HitsView {
    Real* t = nullptr;
    std::int32_t* object = nullptr;
    Real* normal_x = nullptr;
    Real* normal_y = nullptr;
    Real* normal_z = nullptr;
    /// Where rays may start that leave the hit on the outer or the inner side of the surface with
    /// SelfHits::exact: their own start is no hit at any t > 0. With SelfHits::note the hit point.
    /// Wanted only together with normals; the scalar kernel does not fill them.
    Real* outer_start[3] = {};
    Real* inner_start[3] = {};
    Real* point[3] = {};              ///< the hit's own point, likewise
    std::int32_t* surface = nullptr;  ///< a number for StartsView, likewise
};

/// What rays that leave earlier hits start on, `count` elements each: with SelfHits::exact they
/// meet that surface again only where they truly do, however shallow below it they go. `point` and
/// `surface` are what HitsView got; for rays that leave on the inner side of the surface, the
/// complement ~surface. `no_start` is a ray from elsewhere; other numbers must not be given.
template <class Real>
struct StartsView {
    const Real* point[3] = {};
    const std::int32_t* surface = nullptr;
};

inline constexpr std::int32_t no_start = std::numeric_limits<std::int32_t>::min();

/// One meeting of a ray with a surface.
template <class Real>
struct SurfaceHit {
    Real t = 0;
    std::int32_t object = -1;
    Real normal[3] = {};  ///< unit, outwards
};

/// Holds the t of a hit, as infinite precision has it: low <= t <= high. Empty, low > high, for no
/// hit.
struct HitBounds {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    [[nodiscard]] bool empty() const
    {
        return low > high;
    }
};

/// A scene made ready for rays of the caller's own, by the packet kernels or the scalar
/// reference. `Real` is float or double. All members may be called from several threads at
/// once; `closest_hits` and `occluded` allocate nothing with the packet kernels.
template <class Real>
class RayScene {
public:
    /// Of the options `kernel`, `isa`, `width`, `accuracy`, `self_hits` and `traversal` count.
    /// Throws as render() does.
    PACKTRACE_API explicit RayScene(const Scene& scene, const RenderOptions& options = {});
    PACKTRACE_API ~RayScene();
    PACKTRACE_API RayScene(RayScene&&) noexcept;
    PACKTRACE_API RayScene& operator=(RayScene&&) noexcept;

    /// The first hit of each ray; at equal t that of the lower object number.
    PACKTRACE_API void closest_hits(const RaysView<Real>& rays, const HitsView<Real>& hits) const;

    /// The same of rays that leave earlier hits, from HitsView's outer_start or inner_start. With
    /// SelfHits::note, and the scalar kernel, `starts` changes nothing.
    PACKTRACE_API void closest_hits(const RaysView<Real>& rays, const StartsView<Real>& starts,
                                    const HitsView<Real>& hits) const;

    /// mask[i] becomes 1 where ray i hits anything, else 0.
    PACKTRACE_API void occluded(const RaysView<Real>& rays, std::uint8_t* mask) const;

    /// Every hit of each ray, sorted by t, then object; `take` is called once a ray, in order.
    /// A ray that touches a surface without crossing it may meet it twice at the same t.
    using TakeHits = std::function<void(std::size_t ray, std::span<const SurfaceHit<Real>> hits)>;
    PACKTRACE_API void all_hits(const RaysView<Real>& rays, const TakeHits& take) const;

    /// bounds[i] gets proven bounds of the t at which ray i first hits the object of number
    /// object[i] between its t_min and t_max; an empty interval where object[i] is -1, or where the
    /// ray surely hits that object nowhere there. `object` is what closest_hits() gave; its t is
    /// not looked at, and no kernel takes part. "First hits" means what infinite precision makes of
    /// the ray's numbers as given in `Real` and of the doubles in Scene::objects. Bounds are rarely
    /// more than a last place of double apart, but where the ray only touches the object, or
    /// hits it at its rim, up to all of its range. Takes some 10 µs a ray.
    PACKTRACE_API void bound_closest_hits(const RaysView<Real>& rays, const std::int32_t* object,
                                          HitBounds* bounds) const;

    /// The same of all hits of ray number `ray`, which all_hits() gave: bounds[i] is that of
    /// hits[i]. Where single precision or double does not tell two hits of an object apart, they
    /// are taken in order. `bounds` is as long as `hits`.
    PACKTRACE_API void bound_all_hits(const RaysView<Real>& rays, std::size_t ray,
                                      std::span<const SurfaceHit<Real>> hits,
                                      std::span<HitBounds> bounds) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace packtrace
