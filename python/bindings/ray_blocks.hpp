#pragma once

#include "core/arena.hpp"

#include <pybind11/pybind11.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace packtrace::python {

/// The number of rays between checks for Ctrl-C; fewer for slow queries. They are multiples of all
/// block sizes.
inline constexpr std::size_t rays_between_signals = std::size_t{1} << 20;
inline constexpr std::size_t slow_rays_between_signals = std::size_t{1} << 16;

/// Calls `work(first, count)` for the blocks of [begin, end) on `threads` threads; 0 is one per
/// processor.
template <class Work>
void for_each_block(std::size_t begin, std::size_t end, std::size_t block, int threads,
                    const Work& work)
{
    const auto one = [&](std::size_t number) {
        const std::size_t first = begin + number * block;
        work(first, std::min(block, end - first));
    };
    const std::size_t blocks = (end - begin + block - 1) / block;
    if (threads == 1 || blocks <= 1) {
        for (std::size_t number = 0; number < blocks; ++number)
            one(number);
        return;
    }
    run_on_threads(threads, [&] { tbb::parallel_for(std::size_t{0}, blocks, one); });
}

/// Calls `work(first, count)` for the blocks of all rays, without the GIL. Ctrl-C ends it.
template <class Work>
void for_each_ray_block(std::size_t count, std::size_t block, int threads, const Work& work,
                        std::size_t between_signals = rays_between_signals)
{
    for (std::size_t begin = 0; begin < count; begin += between_signals) {
        {
            const pybind11::gil_scoped_release release;
            for_each_block(begin, std::min(count, begin + between_signals), block, threads, work);
        }
        if (PyErr_CheckSignals() != 0)
            throw pybind11::error_already_set();
    }
}

}  // namespace packtrace::python
