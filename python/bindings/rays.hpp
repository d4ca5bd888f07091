#pragma once

#include <pybind11/pybind11.h>

namespace packtrace::python {

void bind_rays(pybind11::module_& module);

}  // namespace packtrace::python
