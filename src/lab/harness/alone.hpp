#pragma once

#include <functional>

namespace packtrace {

/// Runs work that is timed while other processes of the same job on this machine are idle. Empty
/// where there are none.
using Alone = std::function<void(const std::function<void()>& timed)>;

inline void run_alone(const Alone& alone, const std::function<void()>& timed)
{
    alone ? alone(timed) : timed();
}

}  // namespace packtrace
