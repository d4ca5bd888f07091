#pragma once

#include "core/arena.hpp"
#include "interrupt.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace packtrace::python {

/// Of queries. Slow ones take more than some 10 µs a ray.
enum class Speed { fast, slow };

/// The most rays between two checks for Ctrl-C. It divides all block sizes.
[[nodiscard]] constexpr std::size_t longest_piece(Speed speed)
{
    return speed == Speed::fast ? 4096 : 64;
}

/// Calls `work(first, count)` for the blocks of all rays on `threads` threads; 0 is one per
/// processor.
template <class Work>
void for_each_block(std::size_t rays, std::size_t block, int threads, const Work& work)
{
    const auto one = [&](std::size_t number) {
        const std::size_t first = number * block;
        work(first, std::min(block, rays - first));
    };
    const std::size_t blocks = (rays + block - 1) / block;
    if (threads == 1 || blocks <= 1) {
        for (std::size_t number = 0; number < blocks; ++number)
            one(number);
        return;
    }
    run_on_threads(threads, [&] { tbb::parallel_for(std::size_t{0}, blocks, one); });
}

/// Calls `work(first, count)` for all rays, in pieces of at most longest_piece(), without the GIL.
/// The calling thread works, too, and checks for Ctrl-C between its pieces. Ctrl-C ends the work of
/// all threads after their present pieces.
template <class Work>
void for_each_piece(std::size_t rays, std::size_t block, Speed speed, int threads, const Work& work)
{
    const std::size_t longest = longest_piece(speed);
    // While the calling thread waits for the last blocks of the others, it does not check. So the
    // blocks of slow queries are small.
    const std::size_t size = speed == Speed::fast ? block : longest;
    Interrupt interrupt;
    {
        const py::gil_scoped_release release;
        for_each_block(rays, size, threads, [&](std::size_t begin, std::size_t count) {
            for (std::size_t first = begin; first < begin + count; first += longest) {
                interrupt.check_signals_in_time();
                if (interrupt.is_stopped())
                    return;
                work(first, std::min(longest, begin + count - first));
            }
        });
    }
    interrupt.raise();
}

}  // namespace packtrace::python
