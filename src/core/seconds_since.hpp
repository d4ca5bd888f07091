#pragma once

#include <chrono>

namespace packtrace {

/// Seconds of the clock since `start`.
[[nodiscard]] inline double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace packtrace
