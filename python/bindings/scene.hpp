#pragma once

#include <packtrace/scene.hpp>

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

// Converts packtrace.Scene, whose classes are written in Python, to and from the library's Scene.
namespace packtrace::python {

namespace py = pybind11;

/// Raises ValueError, with the name of the object, for a value of the wrong type.
[[nodiscard]] Scene scene_of(py::handle scene);

[[nodiscard]] py::object to_python(Scene scene);
[[nodiscard]] py::object to_python(const Camera& camera);
[[nodiscard]] py::list to_python(const std::vector<Object>& objects);

/// Objects of a scene that was read or generated, until Python code uses them.
struct NativeObjects {
    std::shared_ptr<const std::vector<Object>> objects;
};

}  // namespace packtrace::python
