#pragma once

#include <cstddef>
#include <ctime>
#include <vector>

namespace packtrace {

/// Times work on one or several threads, from its construction on. On one thread it counts
/// processor seconds of this program, without those of other programs; on several, wall-clock
/// seconds.
class Stopwatch {
public:
    explicit Stopwatch(int threads) : one_thread_(threads == 1), start_(now())
    {
    }

    [[nodiscard]] double seconds() const
    {
        return now() - start_;
    }

private:
    [[nodiscard]] double now() const
    {
        timespec time{};
        clock_gettime(one_thread_ ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    bool one_thread_;
    double start_;
};

/// Seconds that `work` takes on `threads` threads.
template <class Work>
[[nodiscard]] double seconds_of(int threads, const Work& work)
{
    const Stopwatch watch(threads);
    work();
    return watch.seconds();
}

/// The seconds of each of `count` works, by repetition: `time(i)` does work i once and returns its
/// seconds. Works take turns, so that a busy moment of the machine affects all of them.
template <class Time>
[[nodiscard]] std::vector<std::vector<double>> time_in_turns(std::size_t count, int repetitions,
                                                             const Time& time)
{
    std::vector<std::vector<double>> seconds(count);
    for (int repetition = 0; repetition < repetitions; ++repetition)
        for (std::size_t i = 0; i < count; ++i)
            seconds[i].push_back(time(i));
    return seconds;
}

}  // namespace packtrace
