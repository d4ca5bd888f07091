#pragma once

#include <packtrace/render.hpp>

#include <pybind11/pybind11.h>

namespace packtrace::python {

/// The options from the keyword arguments that choose a kernel: kernel, isa, lanes, accuracy,
/// self_hits, traversal, threads. Raises ValueError for a word that an argument does not have.
[[nodiscard]] RenderOptions kernel_options(const pybind11::kwargs& arguments);

}  // namespace packtrace::python
