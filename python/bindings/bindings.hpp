#pragma once

#include <pybind11/pybind11.h>

// The parts of the compiled module. bind_report() exists only in builds with src/lab.
namespace packtrace::python {

void bind_compare(pybind11::module_& module);
void bind_pictures(pybind11::module_& module);
void bind_rays(pybind11::module_& module);
void bind_render(pybind11::module_& module);
void bind_report(pybind11::module_& module);
void bind_scene(pybind11::module_& module);

}  // namespace packtrace::python
