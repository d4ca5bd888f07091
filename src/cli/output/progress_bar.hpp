#pragma once

#include <chrono>

namespace packtrace::cli {

enum class Verbosity { normal, quiet };

/// A bar on stderr for renders that take over a second; nothing when stderr is no terminal.
/// It disappears with the object.
class ProgressBar {
public:
    explicit ProgressBar(Verbosity verbosity);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// `share` of the work is done, in [0, 1]. One call at a time.
    void update(double share);

private:
    using Clock = std::chrono::steady_clock;

    bool wanted_;
    bool drawn_ = false;
    Clock::time_point next_;
};

}  // namespace packtrace::cli
