#pragma once

#include <algorithm>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace packtrace {

/// Does `work` on so many threads, or on as many as TBB allows: of more it would warn on standard
/// error. On those of the present arena for 0.
template <class Work>
auto run_on_threads(int threads, const Work& work)
{
    if (threads == 0)
        return work();
    const std::size_t allowed =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    tbb::task_arena arena(static_cast<int>(std::min(static_cast<std::size_t>(threads), allowed)));
    return arena.execute(work);
}

}  // namespace packtrace
