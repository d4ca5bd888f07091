#pragma once

#include "kernel_abi/scene_view.hpp"
#include "kernels/halves.hpp"

// What an equation in double (abi::SurfaceForm) says along rays of either precision.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// What a sphere that has a shape of its own would have for a form.
inline abi::SurfaceForm form_of(const abi::SphereShape& sphere, abi::Sharpened sharpened)
{
    abi::SurfaceForm form{};
    for (int axis = 0; axis < 3; ++axis) {
        form.anchor[axis] = sphere.center[axis];
        form.curvature[axis] = 1.0 / sphere.radius;
    }
    form.constant = -sphere.radius;
    form.clip_low = -__builtin_inf();
    form.clip_high = __builtin_inf();
    form.met_again = abi::MetAgain::from_inside;
    form.sharpened = sharpened;
    return form;
}

/// Calls `visit` with the form of a surface.
template <class Real, class Visit>
inline void with_form(const abi::SceneView<Real>& scene, lane_int<Real> surface, const Visit& visit)
{
    const abi::SurfacePlace place = scene.places[surface];
    const abi::SurfacePlace index = place & abi::place_mask;
    if (abi::is_other_shape(place))
        return visit(scene.forms[index]);
    const bool solved_again = (place & abi::finished_bit) != 0;
    visit(form_of(scene.sphere_shapes[index],
                  solved_again ? abi::Sharpened::nothing : scene.sharpened_spheres));
}

/// A form along the line P + t d: constant + 2 slope t + bend t², and its height for clipping.
template <class Real>
struct FormAlong {
    vreal<Real> constant, slope, bend;
    vreal<Real> height, climb;
};

/// A symmetric matrix times a vector.
inline Vec3v<double> bent(const double (&m)[6], const Vec3v<double>& v)
{
    const Vec3v<double> rows[3] = {{vreal<double>(m[0]), vreal<double>(m[3]), vreal<double>(m[4])},
                                   {vreal<double>(m[3]), vreal<double>(m[1]), vreal<double>(m[5])},
                                   {vreal<double>(m[4]), vreal<double>(m[5]), vreal<double>(m[2])}};
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

inline FormAlong<double> along(const abi::SurfaceForm& form, const Vec3v<double>& point,
                               const Vec3v<double>& dir)
{
    const Vec3v<double> p = point - broadcast(form.anchor);
    const Vec3v<double> normal = broadcast(form.normal);
    const Vec3v<double> clip = broadcast(form.clip);
    const Vec3v<double> gradient = normal + bent(form.curvature, p);
    FormAlong<double> result;
    result.constant = dot(gradient + normal, p) + vreal<double>(form.constant);
    result.slope = dot(gradient, dir);
    result.bend = dot(bent(form.curvature, dir), dir);
    result.height = dot(clip, p) + vreal<double>(form.clip_offset);
    result.climb = dot(clip, dir);
    return result;
}

/// For floats everything that can cancel is computed in double, and rounded once.
inline FormAlong<float> along(const abi::SurfaceForm& form, const Vec3v<float>& point,
                              const Vec3v<float>& dir)
{
    const FormAlong<double> low = along(form, low_half(point), low_half(dir));
    const FormAlong<double> high = along(form, high_half(point), high_half(dir));
    return {joined(low.constant, high.constant), joined(low.slope, high.slope),
            joined(low.bend, high.bend), joined(low.height, high.height),
            joined(low.climb, high.climb)};
}

/// Lanes in which a height is of the surface.
template <class Real>
inline vmask<Real> within_clip(const abi::SurfaceForm& form, const vreal<Real>& height)
{
    return (height >= vreal<Real>(static_cast<Real>(form.clip_low))) &
           (height <= vreal<Real>(static_cast<Real>(form.clip_high)));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
