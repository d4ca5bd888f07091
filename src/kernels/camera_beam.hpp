#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/beam.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
inline Real dot3(const Real (&a)[3], const Real (&b)[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A tile's middle direction, and from there the way to its right and upper edge.
template <class Real>
struct TileAxes {
    Real middle[3], right[3], up[3];

    explicit TileAxes(const abi::TileJob<Real>& job)
    {
        const abi::CameraView<Real>& camera = *job.camera;
        // From pixel to pixel, or for samples from edge to edge.
        const int side = job.samples != nullptr ? abi::tile_size : abi::tile_size - 1;
        const Real half = Real(0.5) * static_cast<Real>(side);
        const Real x = static_cast<Real>(job.x) + camera.first_x + half;
        const Real y = camera.first_y - static_cast<Real>(job.y) - half;
        for (int i = 0; i < 3; ++i) {
            middle[i] = camera.forward[i] + x * camera.right[i] + y * camera.up[i];
            right[i] = half * camera.right[i];
            up[i] = half * camera.up[i];
        }
    }
};

/// The squared tangent of the angle between a tile's middle and its farthest corner; negative
/// when a corner is a right angle away or more.
template <class Real>
inline Real widest_tangent2(const TileAxes<Real>& tile, Real length)
{
    const Real right_along = dot3(tile.right, tile.middle) / length;
    const Real up_along = dot3(tile.up, tile.middle) / length;
    const Real sides2 = dot3(tile.right, tile.right) + dot3(tile.up, tile.up);
    const Real cross = Real(2) * dot3(tile.right, tile.up);
    Real widest = 0;
    for (int corner = 0; corner < 4; ++corner) {
        const Real x = (corner & 1) ? Real(1) : Real(-1);
        const Real y = (corner & 2) ? Real(1) : Real(-1);
        const Real offset_along = x * right_along + y * up_along;
        const Real along = length + offset_along;
        if (!(along > 0))
            return Real(-1);
        const Real across2 = sides2 + x * y * cross - offset_along * offset_along;
        const Real tangent2 = across2 / (along * along);
        widest = tangent2 > widest ? tangent2 : widest;
    }
    return widest;
}

/// The beam through a tile: around its middle, as wide as its farthest corner.
template <class Real>
inline Beam<Real> camera_beam(const abi::TileJob<Real>& job)
{
    const TileAxes<Real> tile(job);
    const Real length = square_root(dot3(tile.middle, tile.middle));
    const Real widest = widest_tangent2(tile, length);
    Beam<Real> beam;
    for (int i = 0; i < 3; ++i) {
        beam.base[i] = job.camera->origin[i];
        beam.axis[i] = tile.middle[i] / length;
    }
    if (widest < 0)
        return beam;
    beam.cosine = Real(1) / square_root(Real(1) + widest);
    beam.sine = square_root(widest) * beam.cosine;
    beam.reach = static_cast<Real>(__builtin_inf());
    beam.bounded = true;
    return beam;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
