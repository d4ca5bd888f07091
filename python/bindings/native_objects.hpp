#pragma once

#include <memory>
#include <vector>

#include <packtrace/scene.hpp>

namespace packtrace::python {

/// Objects of a scene that was read or generated, before anyone asks for them in Python.
struct NativeObjects {
    std::shared_ptr<const std::vector<Object>> objects;
};

}  // namespace packtrace::python
