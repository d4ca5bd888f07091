#include "bindings.hpp"
#include "options.hpp"
#include "pictures.hpp"
#include "progress.hpp"
#include "scene.hpp"
#include "values.hpp"
#include <packtrace/animate.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>

#include <algorithm>
#include <cmath>

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

py::tuple render_scene(py::handle value, const py::kwargs& arguments)
{
    const Scene scene = scene_to_render(value, arguments);
    RenderOptions options = render_options(arguments);
    Progress progress(arguments["progress"]);
    options.progress = [&progress](double share) { progress(share); };
    options.stop = progress.stop();
    return with_real(py::dtype::from_args(arguments["dtype"]), [&](auto real) {
        Image<decltype(real)> image;
        CutRays cut;
        try {
            const py::gil_scoped_release release;
            image = render<decltype(real)>(scene, options, &cut);
        } catch (const StopError&) {
            progress.raise();
        }
        progress.raise();
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
