#pragma once

#include <packtrace/export.hpp>

#include <functional>
#include <stdexcept>
#include <stop_token>

namespace packtrace {

/// Thrown by a function that was stopped before its end. Its output is incomplete.
struct PACKTRACE_API StopError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Progress and cancellation of a long query of rays.
struct QueryWatch {
    /// After a stop request the query throws StopError, some thousand rays later.
    std::stop_token stop = {};
    /// Receives the share of rays that are done, rising to 1. It is called about a hundred times at
    /// most, on the thread of the query, and may request a stop.
    std::function<void(double)> progress = {};
};

}  // namespace packtrace
