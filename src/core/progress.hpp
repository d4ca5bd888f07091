#pragma once

#include <packtrace/stop.hpp>

#include <tbb/task_arena.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <stop_token>
#include <utility>

namespace packtrace {

/// Counts finished pieces of work from any thread and passes the share done to a callback, one
/// call at a time, about a hundred times in all. Knows when to stop.
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

    /// Where the work ends.
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
        // A callback that waits for tasks of its own is given none of this work meanwhile, whose
        // pieces end here, too.
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
