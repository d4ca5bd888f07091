#include "user_sphere_kernel.hpp"

#include <immintrin.h>

namespace packtrace::peers {
namespace {

// Intrinsics of the three widths differ only in their prefix.
#define PACKTRACE_LANES(Name, count, Vector, Mask, p, bits)                                      \
    struct Name {                                                                                \
        PACKTRACE_LANES_ARITHMETIC(count, Vector, p)                                             \
        using M = Mask;                                                                          \
        static M less(V x, V y)                                                                  \
        {                                                                                        \
            return p##_cmp_ps_mask(x, y, _CMP_LT_OQ);                                            \
        }                                                                                        \
        static M not_less(V x, V y)                                                              \
        {                                                                                        \
            return p##_cmp_ps_mask(x, y, _CMP_GE_OQ);                                            \
        }                                                                                        \
        static M both(M x, M y)                                                                  \
        {                                                                                        \
            return static_cast<M>(x & y);                                                        \
        }                                                                                        \
        static M either(M x, M y)                                                                \
        {                                                                                        \
            return static_cast<M>(x | y);                                                        \
        }                                                                                        \
        static bool any(M x)                                                                     \
        {                                                                                        \
            return x != 0;                                                                       \
        }                                                                                        \
        static V select(M m, V x, V y)                                                           \
        {                                                                                        \
            return p##_mask_blend_ps(m, y, x);                                                   \
        }                                                                                        \
        static void store(float* to, M m, V x)                                                   \
        {                                                                                        \
            p##_mask_store_ps(to, m, x);                                                         \
        }                                                                                        \
        static void store(int* to, M m, int x)                                                   \
        {                                                                                        \
            p##_mask_store_epi32(to, m, p##_set1_epi32(x));                                      \
        }                                                                                        \
        static M active(const int* valid)                                                        \
        {                                                                                        \
            const auto lanes = p##_loadu_si##bits(reinterpret_cast<const __m##bits##i*>(valid)); \
            return p##_test_epi32_mask(lanes, lanes);                                            \
        }                                                                                        \
    }

PACKTRACE_LANES(Lanes16, 16, __m512, __mmask16, _mm512, 512);
PACKTRACE_LANES(Lanes8, 8, __m256, __mmask8, _mm256, 256);
PACKTRACE_LANES(Lanes4, 4, __m128, __mmask8, _mm, 128);
#undef PACKTRACE_LANES
#undef PACKTRACE_LANES_ARITHMETIC

}  // namespace

UserSphere user_sphere_avx512()
{
    return {intersect_widths<Lanes16, Lanes8, Lanes4>, occlude_widths<Lanes16, Lanes8, Lanes4>};
}

}  // namespace packtrace::peers
