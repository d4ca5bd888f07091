#pragma once

#if PACKTRACE_LANES > 4
#include <immintrin.h>
#endif

#include "kernel_abi/bvh_view.hpp"
#include "kernels/simd/vfloat8.hpp"

// Sorts the children of a node that are hit. With AVX2 they are sorted in a register, by six rounds
// of Batcher's bitonic network ("Sorting Networks and their Applications", 1968), without branches.
namespace packtrace::PACKTRACE_ISA {
namespace {

#if PACKTRACE_LANES > 4

/// The smaller of each pair of `keys` and `partner` in the elements of `lower`, else the larger.
inline __m256i compare_exchange(__m256i keys, __m256i partner, __m256i lower)
{
    return _mm256_blendv_epi8(_mm256_max_epi32(keys, partner), _mm256_min_epi32(keys, partner),
                              lower);
}

/// Sorts in descending order.
inline __m256i sorted(__m256i keys)
{
    const auto neighbours = [](__m256i v) { return _mm256_shuffle_epi32(v, 0xb1); };
    const auto pairs = [](__m256i v) { return _mm256_shuffle_epi32(v, 0x4e); };
    const auto halves = [](__m256i v) { return _mm256_permute2x128_si256(v, v, 1); };
    keys = compare_exchange(keys, neighbours(keys), _mm256_setr_epi32(0, -1, -1, 0, 0, -1, -1, 0));
    keys = compare_exchange(keys, pairs(keys), _mm256_setr_epi32(0, 0, -1, -1, -1, -1, 0, 0));
    keys = compare_exchange(keys, neighbours(keys), _mm256_setr_epi32(0, -1, 0, -1, -1, 0, -1, 0));
    keys = compare_exchange(keys, halves(keys), _mm256_setr_epi32(0, 0, 0, 0, -1, -1, -1, -1));
    keys = compare_exchange(keys, pairs(keys), _mm256_setr_epi32(0, 0, -1, -1, 0, 0, -1, -1));
    return compare_exchange(keys, neighbours(keys), _mm256_setr_epi32(0, -1, 0, -1, 0, -1, 0, -1));
}

/// The children of a node that are hit, the furthest first.
struct ChildOrder {
    alignas(32) std::int32_t slot[abi::node_width];
    int count;

    /// Distances are not negative, so they sort as integers do. Their last three bits are replaced
    /// by the slot.
    ChildOrder(std::uint32_t met, vfloat8 t_near) : count(__builtin_popcount(met))
    {
        const __m256i slots = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        const __m256i bits = _mm256_sllv_epi32(_mm256_set1_epi32(1), slots);
        const __m256i met_bits = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(met)), bits);
        const __m256i distances = _mm256_andnot_si256(_mm256_set1_epi32(abi::node_width - 1),
                                                      _mm256_castps_si256(t_near.v));
        const __m256i keys =
            _mm256_blendv_epi8(_mm256_set1_epi32(-1), _mm256_or_si256(distances, slots),
                               _mm256_cmpeq_epi32(met_bits, bits));
        _mm256_store_si256(reinterpret_cast<__m256i*>(slot),
                           _mm256_and_si256(sorted(keys), _mm256_set1_epi32(abi::node_width - 1)));
    }
};

#else

/// The children of a node that are hit, the furthest first.
struct ChildOrder {
    std::int32_t slot[abi::node_width];
    int count = 0;

    ChildOrder(std::uint32_t met, vfloat8 t_near)
    {
        alignas(32) float distance[abi::node_width];
        store8(distance, t_near);
        for (; met != 0; met &= met - 1) {
            const int next = __builtin_ctz(met);
            int at = count++;
            for (; at > 0 && distance[slot[at - 1]] < distance[next]; --at)
                slot[at] = slot[at - 1];
            slot[at] = next;
        }
    }
};

#endif

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
