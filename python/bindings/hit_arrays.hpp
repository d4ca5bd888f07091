#pragma once

#include <packtrace/intersect.hpp>

#include <pybind11/numpy.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

// NumPy arrays for hits.
namespace packtrace::python {

namespace py = pybind11;

using OptionalArray = std::optional<py::array>;

template <class T>
T* pointer(py::array& array)
{
    return static_cast<T*>(array.mutable_data());
}

/// Sets `rows` to the three rows of an array (3, n), if there is an array.
template <class Real>
void set_rows(Real* (&rows)[3], OptionalArray& array)
{
    for (py::ssize_t axis = 0; axis < 3 && array; ++axis)
        rows[axis] = pointer<Real>(*array) + axis * array->shape(1);
}

/// The output arrays of hits. rays.py makes and checks them.
struct HitArrays {
    py::array t;
    py::array object;
    OptionalArray normal;
    OptionalArray point;
    OptionalArray outer_start;
    OptionalArray inner_start;
    OptionalArray surface;

    template <class Real>
    [[nodiscard]] HitsView<Real> view()
    {
        HitsView<Real> hits;
        hits.t = pointer<Real>(t);
        hits.object = pointer<std::int32_t>(object);
        Real* normals[3] = {};
        set_rows(normals, normal);
        hits.normal_x = normals[0];
        hits.normal_y = normals[1];
        hits.normal_z = normals[2];
        set_rows(hits.point, point);
        set_rows(hits.outer_start, outer_start);
        set_rows(hits.inner_start, inner_start);
        hits.surface = surface ? pointer<std::int32_t>(*surface) : nullptr;
        return hits;
    }
};

/// Fills in what the scalar kernel does not write: normals of misses, and points, which are NaN for
/// misses.
template <class Real>
void complete_scalar(const RaysView<Real>& rays, const HitsView<Real>& hits)
{
    const Real* const org[3] = {rays.org_x, rays.org_y, rays.org_z};
    const Real* const dir[3] = {rays.dir_x, rays.dir_y, rays.dir_z};
    Real* const normal[3] = {hits.normal_x, hits.normal_y, hits.normal_z};
    for (std::size_t i = 0; i < rays.count; ++i) {
        const bool missed = hits.object[i] < 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (missed && normal[axis] != nullptr)
                normal[axis][i] = 0;
            if (hits.point[axis] != nullptr)
                hits.point[axis][i] = missed ? std::numeric_limits<Real>::quiet_NaN()
                                             : org[axis][i] + hits.t[i] * dir[axis][i];
        }
    }
}

/// Joins the blocks of all hits into (offsets, t, object, normal). `offsets` has the start of each
/// ray's hits.
template <class Real>
py::tuple joined(const std::vector<std::vector<SurfaceHit<Real>>>& found,
                 py::array_t<std::int64_t> offsets)
{
    const py::ssize_t count = offsets.at(offsets.size() - 1);
    py::array_t<Real> t(count);
    py::array_t<std::int32_t> object(count);
    py::array_t<Real> normal({count, py::ssize_t{3}});
    Real* to_t = t.mutable_data();
    std::int32_t* to_object = object.mutable_data();
    Real* to_normal = normal.mutable_data();
    {
        const py::gil_scoped_release release;
        for (const auto& hits : found)
            for (const SurfaceHit<Real>& hit : hits) {
                *to_t++ = hit.t;
                *to_object++ = hit.object;
                to_normal = std::copy_n(hit.normal, 3, to_normal);
            }
    }
    return py::make_tuple(offsets, t, object, normal);
}

}  // namespace packtrace::python
