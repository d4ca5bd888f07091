#pragma once

#include <optional>

#include <tbb/global_control.h>

namespace packtrace::cli {

/// While it lives the program works on `threads` threads, in whatever arena; 0 leaves TBB's own
/// number. Where the system starts fewer, or more are of no use, it takes fewer and says so on
/// standard error. `others` are threads that the program starts besides.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads, int others = 0);

private:
    std::optional<tbb::global_control> control_;
};

}  // namespace packtrace::cli
