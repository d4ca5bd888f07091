#pragma once

#include "worker.hpp"
#include <packtrace/stop.hpp>

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>
#include <optional>
#include <stop_token>
#include <thread>

// Ends long work without the GIL at Ctrl-C.
namespace packtrace::python {

namespace py = pybind11;

/// Python runs signal handlers only on its main thread, when that thread asks for them. Calls ask
/// this often.
inline constexpr std::chrono::milliseconds time_between_signals{50};

/// Requests a stop at Ctrl-C, and when a Python function that the work calls raises an exception.
/// Keeps the first exception. Make it on the thread that Python called.
class Interrupt {
public:
    [[nodiscard]] std::stop_token stop() const
    {
        return stop_.get_token();
    }

    [[nodiscard]] bool is_stopped() const
    {
        return stop_.stop_requested();
    }

    /// Calls a Python function, or None, from any thread.
    template <class... Arguments>
    void call(const py::object& function, const Arguments&... arguments)
    {
        if (!function.is_none())
            keep_exception([&] { function(arguments...); });
    }

    /// Runs the handlers of signals that have arrived.
    void check_signals()
    {
        keep_exception([] {
            if (PyErr_CheckSignals() != 0)
                throw py::error_already_set();
        });
    }

    /// Does so if it is time, and if this is the thread that Python called. It may be called often.
    void check_signals_in_time()
    {
        if (std::this_thread::get_id() != maker_ || Clock::now() - checked_ < time_between_signals)
            return;
        checked_ = Clock::now();
        check_signals();
    }

    /// Throws the exception that was kept, if any. The caller must hold the GIL.
    void raise() const
    {
        if (raised_)
            throw py::error_already_set(*raised_);
    }

private:
    using Clock = std::chrono::steady_clock;

    template <class Work>
    void keep_exception(const Work& work)
    {
        // Do not wait for the GIL unless it is needed.
        if (is_stopped())
            return;
        const py::gil_scoped_acquire acquire;
        if (raised_)
            return;
        try {
            work();
        } catch (py::error_already_set& error) {
            // While `work` ran, another thread may have had the GIL.
            if (!raised_)
                raised_.emplace(error);
            stop_.request_stop();
        }
    }

    std::thread::id maker_ = std::this_thread::get_id();
    Clock::time_point checked_ = Clock::now();
    std::stop_source stop_;
    std::optional<py::error_already_set> raised_;  ///< protected by the GIL
};

/// Runs `work`, which stops at `interrupt.stop()`, on another thread and without the GIL. Meanwhile
/// this thread checks for signals. Throws what `work` throws, or the exception that stopped it.
template <class Work>
void run_interruptibly(Interrupt& interrupt, const Work& work)
{
    const BorrowedWorker worker;
    try {
        const py::gil_scoped_release release;
        std::future<void> done = worker.start(std::packaged_task<void()>(work));
        while (done.wait_for(time_between_signals) != std::future_status::ready)
            interrupt.check_signals();
        done.get();
    } catch (const StopError&) {
        interrupt.raise();
        throw;
    }
    interrupt.raise();
}

}  // namespace packtrace::python
