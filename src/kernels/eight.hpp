#pragma once

#if defined(__aarch64__)
#include "kernels/native/eight_neon.hpp"
#elif PACKTRACE_LANES == 4
#include "kernels/native/eight_sse.hpp"
#else
#include "kernels/native/eight_avx.hpp"
#endif
