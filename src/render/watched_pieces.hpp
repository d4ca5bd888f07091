#pragma once

#include <algorithm>
#include <cstddef>

#include <packtrace/stop.hpp>

namespace packtrace {

/// Calls `work(first, count)` for all `rays`, a piece after the other where the query is watched.
/// Throws StopError as QueryWatch says.
template <class Work>
void for_watched_pieces(std::size_t rays, const QueryWatch& watch, const Work& work)
{
    constexpr std::size_t watched_rays = 4096;
    const bool watched = watch.stop.stop_possible() || watch.progress;
    const std::size_t longest = watched ? watched_rays : rays;
    const std::size_t step = rays / 100 + 1;
    std::size_t reported = 0;
    for (std::size_t first = 0; first < rays; first += longest) {
        if (watch.stop.stop_requested())
            throw StopError("the query was asked to stop");
        const std::size_t done = std::min(rays, first + longest);
        work(first, done - first);
        if (watch.progress && (done == rays || done - reported >= step)) {
            reported = done;
            watch.progress(static_cast<double>(done) / static_cast<double>(rays));
        }
    }
}

}  // namespace packtrace
