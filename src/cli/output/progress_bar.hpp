#pragma once

#include <chrono>
#include <cmath>
#include <iostream>
#include <string>
#include <unistd.h>

namespace packtrace::cli {

enum class Verbosity { normal, quiet };

/// A progress bar on standard error for renders that take over a second. Without a terminal it
/// shows nothing. The destructor removes the bar.
class ProgressBar {
public:
    explicit ProgressBar(Verbosity verbosity)
        : wanted_(verbosity == Verbosity::normal && isatty(STDERR_FILENO) != 0),
          next_(Clock::now() + std::chrono::seconds(1))
    {
    }
    ~ProgressBar()
    {
        // Go back to the start of the line and clear it.
        if (drawn_)
            std::cerr << "\r\033[K" << std::flush;
    }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Shows the share of the work that is done, in [0, 1]. Not thread-safe.
    void update(double share)
    {
        if (!wanted_ || Clock::now() < next_)
            return;
        constexpr std::size_t bar_width = 40;
        drawn_ = true;
        next_ = Clock::now() + std::chrono::milliseconds(100);
        const auto filled = static_cast<std::size_t>(std::lround(share * bar_width));
        const std::string bar = std::string(filled, '#') + std::string(bar_width - filled, '.');
        std::cerr << "\r[" + bar + "] " + std::to_string(std::lround(100.0 * share)) + " %"
                  << std::flush;
    }

private:
    using Clock = std::chrono::steady_clock;

    bool wanted_;
    bool drawn_ = false;
    Clock::time_point next_;
};

}  // namespace packtrace::cli
