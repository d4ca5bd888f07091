#pragma once

#include "kernel_abi/kernel_table.hpp"
#include "kernels/beam.hpp"

// Camera rays of a tile, along its Z-order curve: 2, 4, 8 or 16 neighbours are a block of
// 2x1, 2x2, 4x2 or 4x4 pixels, so packets of every width are compact and in the same order.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Every second bit of a number in a tile's Z-order, from bit 0.
constexpr int even_bits(int number)
{
    return (number & 1) | ((number >> 1) & 2) | ((number >> 2) & 4) | ((number >> 3) & 8);
}

/// Column and row in the tile of each ray.
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

/// The rays of a tile's packet that are within its width and height, or its samples.
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

/// The camera of one tile: a copy, which no store to the tile's memory can change, so that it
/// stays in registers.
template <class Real>
struct TileCamera {
    abi::CameraView<Real> view;
    Real left, top;      ///< canvas position of the tile's first pixel
    const Real* column;  ///< of each ray, counted from there
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

/// Rays `first` to `first + lanes`: directions forward + x right + y up, made unit for the
/// models that want it.
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
