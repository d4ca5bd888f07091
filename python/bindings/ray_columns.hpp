#pragma once

#include <packtrace/intersect.hpp>

#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

// Reads rays from arrays with any strides, block by block, as columns.
namespace packtrace::python {

namespace py = pybind11;

/// One component of rays in NumPy's memory, with `stride` bytes from one ray to the next.
struct Column {
    const char* data = nullptr;
    std::ptrdiff_t stride = 0;
};

template <class Real>
[[nodiscard]] bool is_contiguous(const Column& column)
{
    return column.stride == sizeof(Real) &&
           reinterpret_cast<std::uintptr_t>(column.data) % alignof(Real) == 0;
}

/// A column of an array (n, 3), or the only one of an array (n,).
[[nodiscard]] inline Column column_of(const py::array& array, py::ssize_t axis = 0)
{
    const auto* const data = static_cast<const char*>(array.data());
    const py::ssize_t step = array.ndim() > 1 ? array.strides(1) : 0;
    return {data + axis * step, array.shape(0) == 0 ? 0 : array.strides(0)};
}

/// The rays per block: if they are sorted into columns, and if columns are used directly.
inline constexpr std::size_t gathered_rays = 4096;
inline constexpr std::size_t direct_rays = 65536;
/// The rays per block if a column is one number for all rays. The column is written once and must
/// stay in the cache.
inline constexpr std::size_t constant_rays = 16384;

/// Blocks of columns of `count` elements. A contiguous column is used directly, a column with one
/// number for all rays is written once, and other columns are gathered.
template <class Real, std::size_t columns>
class ColumnBlocks {
public:
    /// A thread's memory for gathered columns.
    using Buffer = std::vector<Real>;

    explicit ColumnBlocks(const std::array<Column, columns>& sources) : sources_(sources)
    {
        for (const Column& source : sources_)
            if (source.stride != 0 && !is_contiguous<Real>(source))
                block_ = gathered_rays;
            else if (source.stride == 0 && source.data != nullptr)
                block_ = std::min(block_, constant_rays);
        for (std::size_t i = 0; i < columns; ++i)
            if (sources_[i].stride == 0 && sources_[i].data != nullptr)
                constant_[i].assign(block_, element(sources_[i], 0));
    }

    [[nodiscard]] std::size_t block_size() const
    {
        return block_;
    }

    /// The columns of the rays [first, first + count). `count` is at most block_size().
    [[nodiscard]] std::array<const Real*, columns> block(std::size_t first, std::size_t count,
                                                         Buffer& buffer) const
    {
        std::array<const Real*, columns> result;
        std::size_t i = 0;
        while (i < columns) {
            const Column& source = sources_[i];
            const std::size_t here = i++;
            if (source.stride == 0) {
                result[here] = constant_[here].data();
            } else if (is_contiguous<Real>(source)) {
                result[here] = reinterpret_cast<const Real*>(source.data) + first;
            } else if (here % 3 == 0 && here + 3 <= columns &&
                       sources_[here + 1].stride == source.stride) {
                for (std::size_t axis = 0; axis < 3; ++axis)
                    result[here + axis] = room(here + axis, buffer);
                gather_vectors(here, first, count, buffer);
                i = here + 3;
            } else {
                result[here] = gather(source, first, count, room(here, buffer));
            }
        }
        return result;
    }

private:
    [[nodiscard]] static Real element(const Column& column, std::size_t i)
    {
        Real value;
        std::memcpy(&value, column.data + static_cast<std::ptrdiff_t>(i) * column.stride,
                    sizeof value);
        return value;
    }

    [[nodiscard]] Real* room(std::size_t column, Buffer& buffer) const
    {
        buffer.resize(columns * block_);
        return buffer.data() + column * block_;
    }

    /// Gathers the components of vectors, which start at column `x`, in one pass.
    void gather_vectors(std::size_t x, std::size_t first, std::size_t count, Buffer& buffer) const
    {
        const char* from[3];
        Real* to[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Column& source = sources_[x + axis];
            from[axis] = source.data + static_cast<std::ptrdiff_t>(first) * source.stride;
            to[axis] = room(x + axis, buffer);
        }
        const std::ptrdiff_t stride = sources_[x].stride;
        constexpr std::ptrdiff_t size = sizeof(Real);
        if (stride == 3 * size && from[1] == from[0] + size && from[2] == from[1] + size &&
            reinterpret_cast<std::uintptr_t>(from[0]) % alignof(Real) == 0)
            return split_vectors(reinterpret_cast<const Real*>(from[0]), count, to);
        for (std::size_t i = 0; i < count; ++i) {
            const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) * stride;
            std::memcpy(to[0] + i, from[0] + at, sizeof(Real));
            std::memcpy(to[1] + i, from[1] + at, sizeof(Real));
            std::memcpy(to[2] + i, from[2] + at, sizeof(Real));
        }
    }

    /// Splits contiguous vectors, as in most arrays (n, 3). The compiler knows their distance.
    static void split_vectors(const Real* from, std::size_t count, Real* const (&to)[3])
    {
        Real* const x = to[0];
        Real* const y = to[1];
        Real* const z = to[2];
        for (std::size_t i = 0; i < count; ++i) {
            x[i] = from[3 * i];
            y[i] = from[3 * i + 1];
            z[i] = from[3 * i + 2];
        }
    }

    [[nodiscard]] const Real* gather(const Column& source, std::size_t first, std::size_t count,
                                     Real* to) const
    {
        for (std::size_t i = 0; i < count; ++i)
            to[i] = element(source, first + i);
        return to;
    }

    std::array<Column, columns> sources_;
    std::array<std::vector<Real>, columns> constant_;
    std::size_t block_ = direct_rays;
};

/// Origins, directions (n, 3), t_min and t_max (n,).
struct RayArrays {
    py::array origins;
    py::array directions;
    py::array t_min;
    py::array t_max;

    [[nodiscard]] std::size_t count() const
    {
        return static_cast<std::size_t>(origins.shape(0));
    }

    [[nodiscard]] std::array<Column, 8> columns() const
    {
        return {column_of(origins, 0),    column_of(origins, 1),    column_of(origins, 2),
                column_of(directions, 0), column_of(directions, 1), column_of(directions, 2),
                column_of(t_min),         column_of(t_max)};
    }
};

template <class Real>
[[nodiscard]] RaysView<Real> rays_view(const std::array<const Real*, 8>& columns, std::size_t count)
{
    return {columns[0], columns[1], columns[2], columns[3], columns[4],
            columns[5], columns[6], columns[7], count};
}

}  // namespace packtrace::python
