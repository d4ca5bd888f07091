#include "user_sphere_kernel.hpp"

#include <immintrin.h>

namespace packtrace::peers {
namespace {

// Intrinsics of both widths differ in their prefix alone; masks are vectors of all ones and zeros.
#define PACKTRACE_LANES(Name, count, Vector, Integers, p, bits)                \
    struct Name {                                                              \
        using V = Vector;                                                      \
        using M = Vector;                                                      \
        static constexpr int width = count;                                    \
        static V set(float x)                                                  \
        {                                                                      \
            return p##_set1_ps(x);                                             \
        }                                                                      \
        static V load(const float* x)                                          \
        {                                                                      \
            return p##_load_ps(x);                                             \
        }                                                                      \
        static V add(V x, V y)                                                 \
        {                                                                      \
            return p##_add_ps(x, y);                                           \
        }                                                                      \
        static V sub(V x, V y)                                                 \
        {                                                                      \
            return p##_sub_ps(x, y);                                           \
        }                                                                      \
        static V mul(V x, V y)                                                 \
        {                                                                      \
            return p##_mul_ps(x, y);                                           \
        }                                                                      \
        static V div(V x, V y)                                                 \
        {                                                                      \
            return p##_div_ps(x, y);                                           \
        }                                                                      \
        static V sqrt(V x)                                                     \
        {                                                                      \
            return p##_sqrt_ps(x);                                             \
        }                                                                      \
        static V madd(V x, V y, V z)                                           \
        {                                                                      \
            return p##_fmadd_ps(x, y, z);                                      \
        }                                                                      \
        static V msub(V x, V y, V z)                                           \
        {                                                                      \
            return p##_fmsub_ps(x, y, z);                                      \
        }                                                                      \
        static M less(V x, V y)                                                \
        {                                                                      \
            return p##_cmp_ps(x, y, _CMP_LT_OQ);                               \
        }                                                                      \
        static M not_less(V x, V y)                                            \
        {                                                                      \
            return p##_cmp_ps(x, y, _CMP_GE_OQ);                               \
        }                                                                      \
        static M both(M x, M y)                                                \
        {                                                                      \
            return p##_and_ps(x, y);                                           \
        }                                                                      \
        static M either(M x, M y)                                              \
        {                                                                      \
            return p##_or_ps(x, y);                                            \
        }                                                                      \
        static bool any(M x)                                                   \
        {                                                                      \
            return p##_movemask_ps(x) != 0;                                    \
        }                                                                      \
        static V select(M m, V x, V y)                                         \
        {                                                                      \
            return p##_blendv_ps(y, x, m);                                     \
        }                                                                      \
        static Integers integers(M m)                                          \
        {                                                                      \
            return p##_castps_si##bits(m);                                     \
        }                                                                      \
        static void store(float* to, M m, V x)                                 \
        {                                                                      \
            p##_maskstore_ps(to, integers(m), x);                              \
        }                                                                      \
        static void store(int* to, M m, int x)                                 \
        {                                                                      \
            p##_maskstore_epi32(to, integers(m), p##_set1_epi32(x));           \
        }                                                                      \
        static M active(const int* valid)                                      \
        {                                                                      \
            return p##_castsi##bits##_ps(                                      \
                p##_loadu_si##bits(reinterpret_cast<const Integers*>(valid))); \
        }                                                                      \
    }

PACKTRACE_LANES(Lanes8, 8, __m256, __m256i, _mm256, 256);
PACKTRACE_LANES(Lanes4, 4, __m128, __m128i, _mm, 128);
#undef PACKTRACE_LANES

void intersect(const RTCIntersectFunctionNArguments* args)
{
    switch (args->N) {
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
        case 8:
            return occlude_lanes<Lanes8>(*args);
        case 4:
            return occlude_lanes<Lanes4>(*args);
        default:
            return occlude_any(*args);
    }
}

}  // namespace

UserSphere user_sphere_avx2()
{
    return {intersect, occlude};
}

}  // namespace packtrace::peers
