#pragma once

#include "kernel_abi/scene_view.hpp"
#include "kernels/records.hpp"
#include "kernels/surface_form.hpp"

// Where rays that start on a surface meet that surface again. One root of its quadratic is known
// to be 0, so that it is not looked for, and the constant is 0 whatever rounding makes of it: the
// other root is -2 slope / bend, for every kind of surface. A search that starts a little off
// the surface cannot tell as well; what it says of the own surface is not listened to. As the
// other root is one number, it can be found when the ray is made, in double, where all is at
// hand, and the search stays the one of all other rays, without a test more for each object.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The other root of rays from `point`, which is on the surface; infinite for none. The slope's
/// sign is that of the side they leave on, so that rounding cannot turn it for grazing rays.
template <class Real>
inline vreal<Real> other_root(const abi::SurfaceForm& form, const Vec3v<Real>& point,
                              const Vec3v<Real>& dir, vmask<Real> outside)
{
    const vreal<Real> never(static_cast<Real>(__builtin_inf()));
    const FormAlong<Real> line = along(form, point, dir);
    const vreal<Real> twice = abs(line.slope) + abs(line.slope);
    const vreal<Real> t = select(outside, negated(twice), twice) / line.bend;
    const auto there = (t > vreal<Real>(Real(0))) & (t < never) &
                       within_clip<Real>(form, madd(t, line.climb, line.height));
    return select(there, t, never);
}

/// For the lanes of `active`, each from a point of its own surface; `outside` are those that
/// leave it on the outer side.
template <class Real>
[[gnu::noinline]] vreal<Real> look_for_second_meeting(const abi::SceneView<Real>& scene,
                                                      const vint<Real>& surface,
                                                      const Vec3v<Real>& point,
                                                      const Vec3v<Real>& dir, std::uint32_t outside,
                                                      std::uint32_t active)
{
    vreal<Real> t(static_cast<Real>(__builtin_inf()));
    const vmask<Real> outer = from_bits<Real>(outside & all_lanes<Real>);
    for_each_distinct<Real>(surface, active, [&](lane_int<Real> number, vmask<Real> same) {
        with_form(scene, number, [&](const abi::SurfaceForm& form) {
            if (form.met_again == abi::MetAgain::never)
                return;
            const std::uint32_t leavers =
                form.met_again == abi::MetAgain::from_inside ? bits(same) & ~outside : bits(same);
            if ((leavers & active) != 0)
                t = select(from_bits<Real>(leavers), other_root(form, point, dir, outer), t);
        });
    });
    return t;
}

/// The same, without looking where nothing is met again.
template <class Real>
inline vreal<Real> second_meeting(const abi::SceneView<Real>& scene, const vint<Real>& surface,
                                  const Vec3v<Real>& point, const Vec3v<Real>& dir,
                                  std::uint32_t outside, std::uint32_t active)
{
    const std::uint32_t may_meet = scene.met_again_outside ? active : active & ~outside;
    if (may_meet == 0)
        return vreal<Real>(static_cast<Real>(__builtin_inf()));
    return look_for_second_meeting<Real>(scene, surface, point, dir, outside, may_meet);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
