#pragma once

#include <packtrace/stop.hpp>

#include <tbb/task_arena.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <stop_token>
#include <utility>

namespace packtrace {

/// Counts finished pieces of work and reports the share that is done to a callback, about a hundred
/// times in all, one call at a time. Also watches for stop requests. Thread-safe.
class Progress {
public:
    Progress(int pieces, const std::function<void(double)>& callback, std::stop_token stop = {})
        : pieces_(pieces), step_(pieces / 100 + 1), callback_(callback), stop_(std::move(stop))
    {
    }

    [[nodiscard]] bool is_stopped() const
    {
        return stop_.stop_requested();
    }

    /// Call it at the end of the work. Throws StopError after a stop request.
    void check_stop() const
    {
        if (is_stopped())
            throw StopError("rendering was asked to stop");
    }

    void finish_piece()
    {
        if (!callback_)
            return;
        const int done = ++done_;
        if (done % step_ != 0 && done != pieces_)
            return;
        const std::lock_guard lock(mutex_);
        // Isolated, so that a callback that waits for its own tasks is not given pieces of this
        // work, which would call back again.
        tbb::this_task_arena::isolate(
            [&] { callback_(static_cast<double>(done_.load()) / pieces_); });
    }

private:
    int pieces_;
    int step_;
    const std::function<void(double)>& callback_;
    std::stop_token stop_;
    std::atomic<int> done_{0};
    std::mutex mutex_;
};

}  // namespace packtrace
