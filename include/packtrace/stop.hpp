#pragma once

#include <packtrace/export.hpp>

#include <functional>
#include <stdexcept>
#include <stop_token>

namespace packtrace {

/// Thrown by what was asked to stop before its end. What it was to fill in is filled in in part.
struct PACKTRACE_API StopError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Progress and cancellation of a long query of rays.
struct QueryWatch {
    /// When a stop is requested the query throws StopError after some thousand more rays.
    std::stop_token stop = {};
    /// Called about a hundred times with the share of rays done, rising to 1, on the thread of the
    /// query. May request a stop.
    std::function<void(double)> progress = {};
};

}  // namespace packtrace
