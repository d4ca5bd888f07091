#include "bindings.hpp"
#include "pictures.hpp"
#include <packtrace/compare.hpp>

namespace packtrace::python {
namespace {

template <class Real>
Comparison compare_arrays(const py::array& a, const py::array& b, const CompareOptions& options)
{
    const Image<Real> first = to_image<Real>(a);
    const Image<Real> second = to_image<Real>(b);
    const py::gil_scoped_release release;
    return compare(first, second, options);
}

template <class Real>
Image<float> heatmap_of_arrays(const py::array& a, const py::array& b)
{
    const Image<Real> first = to_image<Real>(a);
    const Image<Real> second = to_image<Real>(b);
    const py::gil_scoped_release release;
    return heatmap(first, second);
}

}  // namespace

void bind_compare(py::module_& module)
{
    module.def("compare", [](const py::array& a, const py::array& b, double threshold, int worst) {
        const Comparison found = with_real(a.dtype(), [&](auto real) {
            return compare_arrays<decltype(real)>(a, b, {threshold, worst});
        });
        py::list pixels;
        for (const PixelError& pixel : found.worst)
            pixels.append(py::make_tuple(pixel.x, pixel.y, pixel.error));
        return py::make_tuple(
            py::make_tuple(found.max_abs, found.rmse, found.psnr, found.pixels, found.pixels_off),
            pixels);
    });
    module.def("heatmap", [](const py::array& a, const py::array& b) {
        return to_array(with_real(
            a.dtype(), [&](auto real) { return heatmap_of_arrays<decltype(real)>(a, b); }));
    });
}

}  // namespace packtrace::python
