#include "lab/harness/stopwatch.hpp"

#include <ctime>

namespace packtrace {

Stopwatch::Stopwatch(int threads) : one_thread_(threads == 1), start_(now())
{
}

double Stopwatch::now() const
{
    timespec time{};
    clock_gettime(one_thread_ ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace packtrace
