#pragma once

#include <cstddef>
#include <optional>

#include <tbb/global_control.h>

namespace packtrace::cli {

/// While it lives the program works on `threads` threads, in whatever arena; 0 leaves TBB's
/// own number.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads)
    {
        if (threads > 0)
            control_.emplace(tbb::global_control::max_allowed_parallelism,
                             static_cast<std::size_t>(threads));
    }

private:
    std::optional<tbb::global_control> control_;
};

}  // namespace packtrace::cli
