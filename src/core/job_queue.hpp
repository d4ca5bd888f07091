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

/// Runs jobs one after the other on a thread of its own, in the order they come. One job waits at
/// most, besides the one that runs. After a job that throws no other runs. Where the system starts
/// no thread, jobs run as they come.
class JobQueue {
public:
    using Job = std::function<void()>;

    JobQueue()
    {
        try {
            thread_ = std::thread([this] { run_all(); });
        } catch (const std::system_error&) {
            // Without the thread, add() does its work.
        }
    }
    /// Runs what has come; what that throws is lost.
    ~JobQueue()
    {
        end_thread();
    }
    JobQueue(const JobQueue&) = delete;
    JobQueue& operator=(const JobQueue&) = delete;

    /// Waits until there is room. Throws what an earlier job threw.
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

    /// Waits until all jobs are done; no more may come. Throws what a job threw.
    void finish()
    {
        end_thread();
        if (error_)
            std::rethrow_exception(error_);
    }

    /// That jobs took; for after finish().
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

    /// What a job that runs throws.
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
    bool no_more_ = false;      // no more jobs come
    std::exception_ptr error_;  // of the job that threw
    std::thread thread_;
};

}  // namespace packtrace
