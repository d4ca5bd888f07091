#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace packtrace {

/// Calls `visit(element)` for every element of a range. Ranges of thousands of elements are visited
/// in parallel.
template <class Range, class Visit>
void for_each_in_parallel(Range& range, const Visit& visit)
{
    constexpr std::size_t task_elements = 4096;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, range.size(), task_elements),
                      [&](const tbb::blocked_range<std::size_t>& part) {
                          for (std::size_t i = part.begin(); i < part.end(); ++i)
                              visit(range[i]);
                      });
}

}  // namespace packtrace
