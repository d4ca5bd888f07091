#pragma once

#if PACKTRACE_LANES == 1
#include "kernels/simd/native/vfloat8_one.hpp"
#elif defined(__aarch64__)
#include "kernels/simd/native/vfloat8_neon.hpp"
#elif PACKTRACE_LANES == 4
#include "kernels/simd/native/vfloat8_sse.hpp"
#else
#include "kernels/simd/native/vfloat8_avx.hpp"
#endif
