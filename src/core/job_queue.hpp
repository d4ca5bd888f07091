#pragma once

#include "core/seconds_since.hpp"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace packtrace {

/// Runs jobs one by one on its own thread, in the order of add(). At most one job waits besides the
/// one that runs. After a job that throws, no further jobs run. If the system cannot start a
/// thread, add() runs the jobs.
class JobQueue {
public:
    using Job = std::function<void()>;

    JobQueue()
    {
        try {
            thread_ = std::thread([this] { run_all(); });
        } catch (const std::system_error&) {
            // Without a thread, add() runs the jobs.
        }
    }
    /// Runs the remaining jobs. Their exceptions are lost.
    ~JobQueue()
    {
        end_thread();
    }
    JobQueue(const JobQueue&) = delete;
    JobQueue& operator=(const JobQueue&) = delete;

    /// Waits until there is room. Rethrows the exception of an earlier job.
    void add(Job job)
    {
        if (!thread_.joinable())
            return run_here(job);
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return error_ || jobs_.size() < most_jobs; });
        if (error_)
            std::rethrow_exception(error_);
        jobs_.push_back(std::move(job));
        changed_.notify_all();
    }

    /// Waits until all jobs are done. No more jobs may be added. Rethrows the exception of a job.
    void finish()
    {
        end_thread();
        if (error_)
            std::rethrow_exception(error_);
    }

    /// The time of all jobs. Valid after finish().
    [[nodiscard]] double seconds() const
    {
        return seconds_;
    }

private:
    /// The job that runs, and one that waits.
    static constexpr std::size_t most_jobs = 2;

    void run(const Job& job)
    {
        const auto start = std::chrono::steady_clock::now();
        job();
        seconds_ += seconds_since(start);
    }

    void run_here(const Job& job)
    {
        if (!error_)
            error_ = error_of(job);
        if (error_)
            std::rethrow_exception(error_);
    }

    /// Runs a job and returns its exception, if any.
    std::exception_ptr error_of(const Job& job)
    {
        try {
            run(job);
        } catch (...) {
            return std::current_exception();
        }
        return nullptr;
    }

    void run_all()
    {
        std::unique_lock lock(mutex_);
        while (!error_) {
            changed_.wait(lock, [&] { return no_more_ || !jobs_.empty(); });
            if (jobs_.empty())
                return;
            const Job& job = jobs_.front();
            lock.unlock();
            const std::exception_ptr error = error_of(job);
            lock.lock();
            error_ = error;
            jobs_.pop_front();
            changed_.notify_all();
        }
    }

    void end_thread()
    {
        {
            const std::scoped_lock lock(mutex_);
            no_more_ = true;
        }
        changed_.notify_all();
        if (thread_.joinable())
            thread_.join();
    }

    double seconds_ = 0.0;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Job> jobs_;      // the first may be running
    bool no_more_ = false;      // no more jobs will be added
    std::exception_ptr error_;  // of the job that threw
    std::thread thread_;
};

}  // namespace packtrace
