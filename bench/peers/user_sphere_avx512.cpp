#include "user_sphere_kernel.hpp"

#include <immintrin.h>

namespace packtrace::peers {
namespace {

// Intrinsics of the three widths differ in their prefix alone.
#define PACKTRACE_LANES(Name, count, Vector, Mask, p, bits)                                      \
    struct Name {                                                                                \
        using V = Vector;                                                                        \
        using M = Mask;                                                                          \
        static constexpr int width = count;                                                      \
        static V set(float x)                                                                    \
        {                                                                                        \
            return p##_set1_ps(x);                                                               \
        }                                                                                        \
        static V load(const float* x)                                                            \
        {                                                                                        \
            return p##_load_ps(x);                                                               \
        }                                                                                        \
        static V add(V x, V y)                                                                   \
        {                                                                                        \
            return p##_add_ps(x, y);                                                             \
        }                                                                                        \
        static V sub(V x, V y)                                                                   \
        {                                                                                        \
            return p##_sub_ps(x, y);                                                             \
        }                                                                                        \
        static V mul(V x, V y)                                                                   \
        {                                                                                        \
            return p##_mul_ps(x, y);                                                             \
        }                                                                                        \
        static V div(V x, V y)                                                                   \
        {                                                                                        \
            return p##_div_ps(x, y);                                                             \
        }                                                                                        \
        static V sqrt(V x)                                                                       \
        {                                                                                        \
            return p##_sqrt_ps(x);                                                               \
        }                                                                                        \
        static V madd(V x, V y, V z)                                                             \
        {                                                                                        \
            return p##_fmadd_ps(x, y, z);                                                        \
        }                                                                                        \
        static V msub(V x, V y, V z)                                                             \
        {                                                                                        \
            return p##_fmsub_ps(x, y, z);                                                        \
        }                                                                                        \
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

void intersect(const RTCIntersectFunctionNArguments* args)
{
    switch (args->N) {
        case 16:
            return intersect_lanes<Lanes16>(*args);
        case 8:
            return intersect_lanes<Lanes8>(*args);
        case 4:
            return intersect_lanes<Lanes4>(*args);
        default:
            return intersect_any(*args);
    }
}

void occlude(const RTCOccludedFunctionNArguments* args)
{
    switch (args->N) {
        case 16:
            return occlude_lanes<Lanes16>(*args);
        case 8:
            return occlude_lanes<Lanes8>(*args);
        case 4:
            return occlude_lanes<Lanes4>(*args);
        default:
            return occlude_any(*args);
    }
}

}  // namespace

UserSphere user_sphere_avx512()
{
    return {intersect, occlude};
}

}  // namespace packtrace::peers
