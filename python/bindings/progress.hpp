#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <utility>

namespace packtrace::python {

namespace py = pybind11;

/// Calls a Python function from any thread; what it raises first is kept, and ends the calls.
class Progress {
public:
    explicit Progress(py::object call) : call_(std::move(call))
    {
    }

    [[nodiscard]] bool wanted() const
    {
        return !call_.is_none();
    }

    template <class... Arguments>
    void operator()(const Arguments&... arguments)
    {
        const py::gil_scoped_acquire acquire;
        if (raised_)
            return;
        try {
            call_(arguments...);
        } catch (py::error_already_set& error) {
            raised_.emplace(error);
        }
    }

    /// Raises what the function raised. With the GIL.
    void raise() const
    {
        if (raised_)
            throw py::error_already_set(*raised_);
    }

private:
    py::object call_;
    std::optional<py::error_already_set> raised_;
};

}  // namespace packtrace::python
