#include "user_sphere_kernel.hpp"

#include <immintrin.h>

namespace packtrace::peers {
namespace {

// Intrinsics of both widths differ only in their prefix. Masks are vectors of all ones or zeros.
#define PACKTRACE_LANES(Name, count, Vector, Integers, p, bits)                \
    struct Name {                                                              \
        PACKTRACE_LANES_ARITHMETIC(count, Vector, p)                           \
        using M = Vector;                                                      \
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
#undef PACKTRACE_LANES_ARITHMETIC

}  // namespace

UserSphere user_sphere_avx2()
{
    return {intersect_widths<Lanes8, Lanes4>, occlude_widths<Lanes8, Lanes4>};
}

}  // namespace packtrace::peers
