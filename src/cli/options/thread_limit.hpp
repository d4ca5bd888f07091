#pragma once

namespace packtrace::cli {

/// From now on the program works on `threads` threads, in whatever arena; 0 leaves TBB's own
/// number. The limit is never lifted: oneTBB takes memory for that, and ends the program, its work
/// done, where there is none. Where the system starts fewer, or more are of no use, it takes fewer
/// and says so on standard error. `others` are threads that the program starts besides.
void limit_threads(int threads, int others = 0);

}  // namespace packtrace::cli
