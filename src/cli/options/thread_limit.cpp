#include "cli/options/thread_limit.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace packtrace::cli {
namespace {

/// How many threads, at most `wanted`, can run besides this one. The system may allow fewer, and
/// oneTBB ends the program if it cannot start a thread.
int startable_threads(int wanted)
{
    std::mutex mutex;
    std::condition_variable changed;
    bool end = false;
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(wanted));
    try {
        while (static_cast<int>(threads.size()) < wanted)
            threads.emplace_back([&] {
                std::unique_lock lock(mutex);
                changed.wait(lock, [&] { return end; });
            });
    } catch (const std::exception&) {
        // The system allows no more threads, or has no memory for them.
    }
    {
        const std::scoped_lock lock(mutex);
        end = true;
    }
    changed.notify_all();
    for (std::thread& thread : threads)
        thread.join();
    return static_cast<int>(threads.size());
}

/// The largest number of threads per processor. More of them only wait for each other.
constexpr int threads_of_processor = 8;

int useful_threads()
{
    return threads_of_processor *
           static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

/// Returns `threads`, or fewer if so many are useless or not allowed. Reports this in one line.
int possible_threads(int threads, int others)
{
    const int useful = std::min(threads, useful_threads());
    const int startable = std::max(1, 1 + startable_threads(useful - 1 + others) - others);
    if (startable < useful)
        std::fprintf(stderr, "packtrace: --threads %d: the system starts %d, which is used\n",
                     threads, startable);
    else if (useful < threads)
        std::fprintf(stderr, "packtrace: --threads %d: %d are used, %d a processor\n", threads,
                     useful, threads_of_processor);
    return startable;
}

}  // namespace

void limit_threads(int threads, int others)
{
    // Never lifted. The pointer is static, so that leak checkers find it.
    [[maybe_unused]] static const tbb::global_control* volatile limit = nullptr;
    if (threads > 0)
        limit =
            new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(possible_threads(threads, others)));
}

}  // namespace packtrace::cli
