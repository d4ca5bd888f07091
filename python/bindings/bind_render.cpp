#include "bindings.hpp"
#include "core/text.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "pictures.hpp"
#include "scene.hpp"
#include "values.hpp"
#include <packtrace/animate.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>

#include <algorithm>
#include <cmath>
#include <new>

namespace packtrace::python {
namespace {

/// Sets the picture's size. One side alone keeps the aspect ratio.
void set_size(Scene& scene, std::optional<int> width, std::optional<int> height)
{
    for (const auto& [size, key] : {std::pair(width, "width"), std::pair(height, "height")})
        if (size && *size < 1)
            throw_wrong(key, py::int_(*size), "a number of pixels, 1 or more");
    const double shape = static_cast<double>(scene.width) / std::max(1, scene.height);
    if (width && !height)
        height = std::max(1, static_cast<int>(std::lround(*width / shape)));
    if (height && !width)
        width = std::max(1, static_cast<int>(std::lround(*height * shape)));
    scene.width = width.value_or(scene.width);
    scene.height = height.value_or(scene.height);
}

Scene scene_to_render(py::handle value, const py::kwargs& arguments)
{
    Scene scene = scene_of(value);
    set_size(scene, optional_of<int>(arguments["width"], "width"),
             optional_of<int>(arguments["height"], "height"));
    if (const auto frame = optional_of<int>(arguments["frame"], "frame"))
        scene.camera = camera_at(scene, *frame);
    return scene;
}

RenderOptions render_options(const py::kwargs& arguments)
{
    RenderOptions options = kernel_options(arguments);
    from_python(arguments["force_general"], "force_general", options.force_general);
    from_python(arguments["samples"], "samples", options.samples);
    options.adaptive = optional_of<double>(arguments["adaptive"], "adaptive");
    if (const py::object region = arguments["region"]; !region.is_none()) {
        const std::vector<py::object> numbers = elements_of(region, "region");
        if (numbers.size() != 4)
            throw_wrong("region", region, "four whole numbers (x, y, width, height)");
        options.region =
            Region{value_of<int>(numbers[0], "region"), value_of<int>(numbers[1], "region"),
                   value_of<int>(numbers[2], "region"), value_of<int>(numbers[3], "region")};
    }
    return options;
}

/// Raises MemoryError. The message has the memory of a large picture, as that of the program.
[[noreturn]] void throw_no_memory(const Scene& scene, const RenderOptions& options,
                                  std::size_t pixel_bytes)
{
    // A smaller picture is not the reason for a lack of memory.
    constexpr double large = 1e8;
    const Region part = options.region.value_or(Region{0, 0, scene.width, scene.height});
    const double bytes = static_cast<double>(pixel_bytes) * part.width * part.height;
    if (bytes < large)
        throw std::bad_alloc();
    const std::string message = "not enough memory for " + std::to_string(part.width) + " x " +
                                std::to_string(part.height) + " pixels, which alone take " +
                                fixed(1e-9 * bytes, 1) + " GB; render fewer pixels at once";
    PyErr_SetString(PyExc_MemoryError, message.c_str());
    throw py::error_already_set();
}

py::tuple render_scene(py::handle value, const py::kwargs& arguments)
{
    const Scene scene = scene_to_render(value, arguments);
    RenderOptions options = render_options(arguments);
    Interrupt interrupt;
    const py::object progress = arguments["progress"];
    options.progress = [&](double share) { interrupt.call(progress, share); };
    options.stop = interrupt.stop();
    return with_real(py::dtype::from_args(arguments["dtype"]), [&](auto real) {
        Image<decltype(real)> image;
        CutRays cut;
        try {
            run_interruptibly(interrupt,
                              [&] { image = render<decltype(real)>(scene, options, &cut); });
        } catch (const std::bad_alloc&) {
            throw_no_memory(scene, options, 3 * sizeof real);
        }
        return py::make_tuple(to_array(std::move(image)), py::make_tuple(cut.rays, cut.bound));
    });
}

py::list isas()
{
    using namespace py::literals;
    py::list rows;
    for (const IsaInfo& isa : list_isas())
        rows.append(py::dict("name"_a = isa.name, "lanes_single"_a = isa.lanes_single,
                             "lanes_double"_a = isa.lanes_double, "supported"_a = isa.supported));
    return rows;
}

}  // namespace

void bind_render(py::module_& module)
{
    module.def("render", render_scene);
    module.def("isas", isas);
}

}  // namespace packtrace::python
