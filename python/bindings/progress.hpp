#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace packtrace::python {

namespace py = pybind11;

/// Calls a Python function, or None, with the share of the work that is done, from any thread. Also
/// checks for Ctrl-C, on the thread that constructed it. The first exception is kept, and stops the
/// work.
class Progress {
public:
    explicit Progress(py::object call) : call_(std::move(call)), wanted_(!call_.is_none())
    {
    }

    [[nodiscard]] std::stop_token stop() const
    {
        return stop_.get_token();
    }

    template <class... Arguments>
    void operator()(const Arguments&... arguments)
    {
        const bool sees_signals = std::this_thread::get_id() == maker_;
        // Do not wait for the GIL unless it is needed.
        if ((!wanted_ && !sees_signals) || stop_.stop_requested())
            return;
        const py::gil_scoped_acquire acquire;
        if (raised_)
            return;
        try {
            if (sees_signals && PyErr_CheckSignals() != 0)
                throw py::error_already_set();
            if (wanted_)
                call_(arguments...);
        } catch (py::error_already_set& error) {
            raised_.emplace(error);
            stop_.request_stop();
        }
    }

    /// Rethrows the function's exception. The caller must hold the GIL.
    void raise() const
    {
        if (raised_)
            throw py::error_already_set(*raised_);
    }

private:
    py::object call_;
    bool wanted_;
    std::thread::id maker_ = std::this_thread::get_id();
    std::stop_source stop_;
    std::optional<py::error_already_set> raised_;
};

}  // namespace packtrace::python
