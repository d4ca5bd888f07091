// The compiled part of the Python package packtrace: conversions, and calls of the library. The
// public functions and the checks of arrays are in ../packtrace.
#include "bindings.hpp"
#include "scene/language/quote.hpp"
#include "scene/scene_faults.hpp"
#include <packtrace/image_io.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/version.hpp>

#include <pybind11/pybind11.h>

#include <new>
#include <string>
#include <string_view>
#include <utility>

namespace {

namespace py = pybind11;

template <class Error>
void add_error(py::module_& module, const char* name, PyObject* base, const char* documentation)
{
    const py::exception<Error>& error = py::register_exception<Error>(module, name, base);
    error.attr("__module__") = "packtrace";
    error.attr("__doc__") = documentation;
}

void raise(const char* name, const std::string& text)
{
    const py::object type = py::module_::import("packtrace._packtrace").attr(name);
    PyErr_SetString(type.ptr(), text.c_str());
}

/// A message about a scene, with Python's names in place of different names in the scene language.
std::string with_python_names(std::string text)
{
    constexpr std::pair<std::string_view, std::string_view> names[] = {
        {"'image_size'", "'width' x 'height'"},
        {"'viewport_size'", "'viewport'"},
        {"'projection_plane_d'", "'distance'"},
        {"'vertices'", "'contours'"},
        {"'matrix'", "'transform'"},
        {"give it the scene's, see make_material()", "use the material class of its illumination"}};
    for (const auto& [ours, theirs] : names)
        if (const std::size_t at = text.find(ours); at != std::string::npos)
            text.replace(at, ours.size(), theirs);
    return text;
}

/// Registers the errors whose text differs from that of the library.
void translate_texts()
{
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const packtrace::language::SceneFaultError& error) {
            // For a scene made in Python the message has the index in a list: "lights[0]".
            raise("SceneError", with_python_names(error.fault.text_by_index()));
        } catch (const packtrace::ImageError& error) {
            // A file's name need not be UTF-8, but Python's texts must be.
            raise("ImageError", packtrace::language::escape(error.what()));
        } catch (const std::bad_alloc&) {
            PyErr_SetString(PyExc_MemoryError, "not enough memory");
        }
    });
}

}  // namespace

PYBIND11_MODULE(_packtrace, module)
{
    using namespace packtrace;
    module.attr("__version__") = PACKTRACE_VERSION_STRING;
    add_error<SceneError>(module, "SceneError", PyExc_ValueError,
                          "A scene that cannot be used: one line that says what, why, and what to "
                          "do; for text, also where.");
    add_error<ImageError>(
        module, "ImageError", PyExc_OSError,
        "A picture that cannot be read or written: one line that names the file.");
    translate_texts();
    python::bind_scene(module);
    python::bind_pictures(module);
    python::bind_render(module);
    python::bind_rays(module);
    python::bind_compare(module);
#ifdef PACKTRACE_WITH_STUDY
    python::bind_report(module);
#endif
}
