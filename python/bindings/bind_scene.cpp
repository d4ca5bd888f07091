#include "bindings.hpp"
#include "scene.hpp"
#include "values.hpp"
#include <packtrace/animate.hpp>
#include <packtrace/build.hpp>
#include <packtrace/generate.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/validate.hpp>
#include <packtrace/write_scene.hpp>

#include <optional>
#include <utility>

namespace packtrace::python {
namespace {

/// Calls `make` without the GIL.
template <class Make>
auto without_gil(const Make& make)
{
    const py::gil_scoped_release release;
    return make();
}

void warn(const std::vector<std::string>& lines)
{
    for (const std::string& line : lines)
        if (PyErr_WarnEx(PyExc_UserWarning, line.c_str(), 2) != 0)
            throw py::error_already_set();
}

/// Calls `read(take_warning)`, and turns warnings into Python warnings.
template <class Read>
py::object read(const Read& read)
{
    std::vector<std::string> warnings;
    Scene scene = without_gil(
        [&] { return read([&](const std::string& line) { warnings.push_back(line); }); });
    warn(warnings);
    return to_python(std::move(scene));
}

/// The transform of an object after `move`.
template <class Move>
py::tuple moved(py::handle transform, const Move& move)
{
    Object object;
    from_python(transform, "transform", object.transform);
    return to_python(move(std::move(object)).transform);
}

template <class Options>
py::object generated(Scene (*generate)(const Options&), const Options& options)
{
    return to_python(without_gil([&] { return generate(options); }));
}

void bind_text(py::module_& module)
{
    module.def("read_scene", [](const std::string& file) {
        return read([&](const TakeWarning& take) { return read_scene(file, take); });
    });
    module.def("parse_scene", [](const std::string& text, const std::string& name) {
        return read([&](const TakeWarning& take) { return parse_scene(text, name, take); });
    });
    module.def("scene_text", [](py::handle scene) {
        return to_python(without_gil([native = scene_of(scene)] { return scene_text(native); }));
    });
    module.def("validate", [](py::handle scene) {
        without_gil([native = scene_of(scene)] { validate(native); });
    });
}

void bind_transforms(py::module_& module)
{
    module.def("translated", [](py::handle transform, py::handle by) {
        return moved(transform, [&](Object object) {
            return translate(std::move(object), value_of<Vec3>(by, "by"));
        });
    });
    module.def("rotated", [](py::handle transform, py::handle axis, py::handle degrees) {
        return moved(transform, [&](Object object) {
            return rotate(std::move(object), value_of<Vec3>(axis, "axis"),
                          value_of<double>(degrees, "degrees"));
        });
    });
    module.def("scaled", [](py::handle transform, py::handle factors) {
        return moved(transform, [&](Object object) {
            return scale(std::move(object), color_of(factors, "factors"));
        });
    });
    module.def("look_at", [](py::handle position, py::handle target, py::handle up) {
        return to_python(look_at(value_of<Vec3>(position, "position"),
                                 value_of<Vec3>(target, "target"), value_of<Vec3>(up, "up")));
    });
    module.def("camera_at", [](py::handle scene, py::handle frame) {
        return to_python(camera_at(scene_of(scene), value_of<int>(frame, "frame")));
    });
}

void bind_generators(py::module_& module)
{
    module.def("generate_sphereflake", [](int depth, double reflective, bool ground) {
        return generated<SphereflakeOptions>(generate_sphereflake, {depth, reflective, ground});
    });
    module.def("generate_random_spheres",
               [](int count, double radius, std::uint64_t seed, double reflective) {
                   return generated<RandomSpheresOptions>(generate_random_spheres,
                                                          {count, radius, seed, reflective});
               });
    module.def("generate_lattice", [](int edge, double radius, double reflective) {
        return generated<LatticeOptions>(generate_lattice, {edge, radius, reflective});
    });
}

}  // namespace

void bind_scene(py::module_& module)
{
    py::class_<NativeObjects>(module, "NativeObjects").def("take", [](const NativeObjects& native) {
        return to_python(*native.objects);
    });
    bind_text(module);
    bind_transforms(module);
    bind_generators(module);
}

}  // namespace packtrace::python
