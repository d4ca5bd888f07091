#pragma once

#include <packtrace/image.hpp>

#include <pybind11/numpy.h>

#include <memory>
#include <utility>

// Pictures as arrays (height, width, 3).
namespace packtrace::python {

namespace py = pybind11;

/// An array in the picture's own memory, which it keeps alive.
template <class Real>
[[nodiscard]] py::array to_array(Image<Real>&& image)
{
    auto kept = std::make_unique<Image<Real>>(std::move(image));
    Real* const values = kept->rgb.data();
    const py::ssize_t shape[] = {kept->height, kept->width, 3};
    const py::capsule owner(kept.release(), [](void* picture) {
        std::unique_ptr<Image<Real>>(static_cast<Image<Real>*>(picture));
    });
    return py::array_t<Real>(shape, values, owner);
}

/// A copy of a contiguous array of shape (height, width, 3).
template <class Real>
[[nodiscard]] Image<Real> to_image(const py::array& array)
{
    auto image =
        Image<Real>::unset(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
    std::copy_n(static_cast<const Real*>(array.data()), image.rgb.size(), image.rgb.begin());
    return image;
}

/// Calls `use` with a zero of the type of a dtype, float32 or float64.
template <class Use>
auto with_real(const py::dtype& dtype, const Use& use)
{
    return dtype.itemsize() == sizeof(float) ? use(0.0f) : use(0.0);
}

}  // namespace packtrace::python
