#pragma once

#include <condition_variable>
#include <cstddef>
#include <future>
#include <mutex>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace packtrace::python {

/// A thread that runs one task after another, until the process ends.
class Worker {
public:
    /// Throws std::system_error if the system allows no more threads.
    Worker()
    {
        std::thread([this] { run(); }).detach();
    }

    void start(std::packaged_task<void()> task)
    {
        {
            const std::lock_guard lock(mutex_);
            task_ = std::move(task);
        }
        has_task_.notify_one();
    }

private:
    [[noreturn]] void run()
    {
        for (;;) {
            std::unique_lock lock(mutex_);
            has_task_.wait(lock, [this] { return task_.valid(); });
            std::packaged_task<void()> task = std::move(task_);
            lock.unlock();
            task();
        }
    }

    std::mutex mutex_;
    std::condition_variable has_task_;
    std::packaged_task<void()> task_;
};

/// A worker for one task. Workers are reused, because oneTBB takes up to a millisecond, and memory,
/// for each new thread that calls it (oneTBB 2021.8). Make and destroy it with the GIL.
class BorrowedWorker {
public:
    BorrowedWorker() : worker_(take())
    {
    }

    BorrowedWorker(const BorrowedWorker&) = delete;
    BorrowedWorker& operator=(const BorrowedWorker&) = delete;

    ~BorrowedWorker()
    {
        if (worker_ != nullptr)
            idle().push_back(worker_);
    }

    /// Without a worker, the task runs now. Wait for the result before this is destroyed.
    [[nodiscard]] std::future<void> start(std::packaged_task<void()> task) const
    {
        std::future<void> result = task.get_future();
        if (worker_ != nullptr)
            worker_->start(std::move(task));
        else
            task();
        return result;
    }

private:
    /// Null if the system allows no more threads.
    [[nodiscard]] static Worker* take()
    {
        std::vector<Worker*>& workers = idle();
        if (workers.empty()) {
            static std::size_t made = 0;
            workers.reserve(made + 1);  // The destructor must not fail.
            try {
                Worker* const worker = new Worker;
                ++made;
                return worker;
            } catch (const std::system_error&) {
                return nullptr;
            }
        }
        Worker* const last = workers.back();
        workers.pop_back();
        return last;
    }

    /// Protected by the GIL, which also os.fork() holds. Never destroyed, as the workers.
    [[nodiscard]] static std::vector<Worker*>& idle()
    {
        static std::vector<Worker*>& workers = *new std::vector<Worker*>;
        static pid_t process = getpid();
        // A forked process has none of its parent's threads.
        if (process != getpid())
            workers.clear();
        process = getpid();
        return workers;
    }

    Worker* worker_;
};

}  // namespace packtrace::python
