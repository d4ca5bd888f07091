#pragma once

namespace packtrace::bench {

/// Each registers the benchmarks of one file, for every instruction set of the machine.
void register_kernels();
void register_frames();
void register_power();

}  // namespace packtrace::bench
