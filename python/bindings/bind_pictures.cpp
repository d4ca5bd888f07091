#include "bindings.hpp"
#include "image/formats.hpp"
#include "pictures.hpp"
#include <packtrace/image_io.hpp>

namespace packtrace::python {

void bind_pictures(py::module_& module)
{
    module.def("read_image", [](const std::string& file) {
        Image<float> image;
        {
            const py::gil_scoped_release release;
            image = read_image(file);
        }
        return to_array(std::move(image));
    });
    module.def("write_image", [](const std::string& file, const py::array& picture, double gamma) {
        with_real(picture.dtype(), [&](auto real) {
            const auto image = to_image<decltype(real)>(picture);
            const py::gil_scoped_release release;
            write_image(file, image, {.gamma = gamma});
        });
    });
    module.def("to_png", [](const py::array& picture, double gamma) {
        Bytes bytes;
        with_real(picture.dtype(), [&](auto real) {
            const auto image = to_image<decltype(real)>(picture);
            const py::gil_scoped_release release;
            bytes = encode_png(image, {.gamma = gamma});
        });
        return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    });
}

}  // namespace packtrace::python
