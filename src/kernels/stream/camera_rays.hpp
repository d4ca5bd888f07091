#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/geometry/cone.hpp"

// Camera rays of a tile, along its Z-order curve: 2, 4, 8 or 16 neighbours are a block of 2x1, 2x2,
// 4x2 or 4x4 pixels. So packets of every width are compact, and rays have the same order.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Real>
inline Real dot3(const Real (&a)[3], const Real (&b)[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The unit direction of a tile's centre, and the vectors from there to its right and upper edge.
template <class Real>
struct TileAxes {
    Real middle[3], right[3], up[3];

    explicit TileAxes(const abi::TileJob<Real>& job)
    {
        const abi::CameraView<Real>& camera = *job.camera;
        // From pixel centre to pixel centre, or for samples from edge to edge.
        const int side = job.samples != nullptr ? abi::tile_size : abi::tile_size - 1;
        const Real half = Real(0.5) * static_cast<Real>(side);
        const Real x = static_cast<Real>(job.x) + camera.first_x + half;
        const Real y = camera.first_y - static_cast<Real>(job.y) - half;
        for (int i = 0; i < 3; ++i) {
            middle[i] = camera.forward[i] + x * camera.right[i] + y * camera.up[i];
            right[i] = half * camera.right[i];
            up[i] = half * camera.up[i];
        }
        const Real length = square_root(dot3(middle, middle));
        for (Real(*const axis)[3] : {&middle, &right, &up})
            for (Real& component : *axis)
                component /= length;
    }
};

template <class Real>
inline void cross3(Real (&product)[3], const Real (&a)[3], const Real (&b)[3])
{
    for (int i = 0; i < 3; ++i)
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/// A tile's cone with a larger tangent counts as not bounded. Up to this value the tangent's error
/// is at most this many roundoffs: the distance from the centre direction is a difference of
/// products that may cancel, as in views of nearly 180 degrees.
template <class Real>
inline constexpr Real largest_tangent = Real(16);

/// The squared tangent of the angle between a tile's centre and its furthest corner; negative if a
/// corner is nearly a right angle away or more.
template <class Real>
inline Real widest_tangent2(const TileAxes<Real>& tile)
{
    const Real right_along = dot3(tile.right, tile.middle);
    const Real up_along = dot3(tile.up, tile.middle);
    const Real sides2 = dot3(tile.right, tile.right) + dot3(tile.up, tile.up);
    Real right_across[3], up_across[3];
    cross3(right_across, tile.right, tile.middle);
    cross3(up_across, tile.up, tile.middle);
    const Real across2 = dot3(right_across, right_across) + dot3(up_across, up_across);
    const Real cross = Real(2) * dot3(right_across, up_across);
    Real widest = 0;
    for (int corner = 0; corner < 4; ++corner) {
        const Real x = (corner & 1) ? Real(1) : Real(-1);
        const Real y = (corner & 2) ? Real(1) : Real(-1);
        const Real along = Real(1) + (x * right_along + y * up_along);
        // A corner is at most as far away as the longer diagonal, which is below twice the sides.
        if (!(along > 0) ||
            Real(2) * sides2 > largest_tangent<Real> * largest_tangent<Real> * along * along)
            return Real(-1);
        const Real tangent2 = (across2 + x * y * cross) / (along * along);
        widest = tangent2 > widest ? tangent2 : widest;
    }
    return widest;
}

/// The cone of a tile's camera rays: around its centre, as wide as its furthest corner.
template <class Real>
inline Cone<Real> camera_cone(const abi::TileJob<Real>& job)
{
    const TileAxes<Real> tile(job);
    const Real widest = widest_tangent2(tile);
    Cone<Real> cone;
    for (int i = 0; i < 3; ++i) {
        cone.base[i] = job.camera->origin[i];
        cone.axis[i] = tile.middle[i];
    }
    if (widest < 0)
        return cone;
    cone.cosine = Real(1) / square_root(Real(1) + widest);
    cone.sine = square_root(widest) * cone.cosine;
    cone.reach = static_cast<Real>(__builtin_inf());
    cone.bounded = true;
    return cone;
}

/// Every second bit of a number on a tile's Z-order curve, from bit 0.
constexpr int even_bits(int number)
{
    return (number & 1) | ((number >> 1) & 2) | ((number >> 2) & 4) | ((number >> 3) & 8);
}

/// The column and row of each ray in the tile.
template <class Real>
struct TilePixels {
    alignas(64) Real column[abi::tile_pixels] = {};
    alignas(64) Real row[abi::tile_pixels] = {};

    constexpr TilePixels()
    {
        for (int ray = 0; ray < abi::tile_pixels; ++ray) {
            column[ray] = static_cast<Real>(even_bits(ray));
            row[ray] = static_cast<Real>(even_bits(ray >> 1));
        }
    }
};

template <class Real>
constexpr TilePixels<Real> tile_pixels;

/// The lanes of a packet that are within the tile's width and height, or within its samples.
template <class Real>
inline std::uint32_t lanes_inside(const abi::TileJob<Real>& job, int first)
{
    if (job.samples != nullptr)
        return job.samples->count > first ? first_lanes<Real>(job.samples->count - first) : 0;
    if (job.width == abi::tile_size && job.height == abi::tile_size)
        return all_lanes<Real>;
    const vreal<Real> width(static_cast<Real>(job.width));
    const vreal<Real> height(static_cast<Real>(job.height));
    return bits((load(tile_pixels<Real>.column + first) < width) &
                (load(tile_pixels<Real>.row + first) < height));
}

/// The camera of one tile. It is a copy, so that no store to the tile's memory can change it and it
/// stays in registers.
template <class Real>
struct TileCamera {
    abi::CameraView<Real> view;
    Real left, top;      ///< canvas position of the tile's first pixel
    const Real* column;  ///< column of each ray, counted from there
    const Real* row;

    explicit TileCamera(const abi::TileJob<Real>& job)
        : view(*job.camera),
          left(static_cast<Real>(job.x) + view.first_x),
          top(view.first_y - static_cast<Real>(job.y)),
          column(job.samples != nullptr ? job.samples->column : tile_pixels<Real>.column),
          row(job.samples != nullptr ? job.samples->row : tile_pixels<Real>.row)
    {
    }
};

/// The camera rays `first` to `first` + lanes - 1: directions forward + x right + y up, normalised
/// for the models that ask for it.
template <class Real>
inline RayPacket<Real> camera_rays(const TileCamera<Real>& camera, int first, abi::RayUnits units)
{
    const vreal<Real> x = vreal<Real>(camera.left) + load(camera.column + first);
    const vreal<Real> y = vreal<Real>(camera.top) - load(camera.row + first);
    Vec3v<Real> dir =
        madd<Real>(x, broadcast(camera.view.right),
                   madd<Real>(y, broadcast(camera.view.up), broadcast(camera.view.forward)));
    if (units == abi::RayUnits::unit)
        dir = scale<Real>(vreal<Real>(Real(1)) / sqrt(dot(dir, dir)), dir);
    return make_rays<Real>(broadcast(camera.view.origin), dir, camera.view.t_min);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
