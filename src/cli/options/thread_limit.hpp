#pragma once

namespace packtrace::cli {

/// From now on the program uses at most `threads` threads, in all arenas; 0 keeps TBB's number. If
/// the system starts fewer threads, or if so many are useless, it uses fewer and reports this on
/// standard error. `others` is the number of threads that the program starts besides.
///
/// The limit is never lifted: oneTBB allocates for that, and without memory it would end the
/// program after its work.
void limit_threads(int threads, int others = 0);

}  // namespace packtrace::cli
