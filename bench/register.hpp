#pragma once

namespace packtrace::bench {

/// Each function registers the benchmarks of one file.
void register_kernels();
void register_frames();
void register_power();
void register_updates();
void register_lit();

}  // namespace packtrace::bench
