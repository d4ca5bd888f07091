#pragma once

#include "kernels/simd/lanes.hpp"

#include <cstddef>
#include <cstdint>

// A register of bits, as the compilers' own vector type: it has & | ^ ~ << >> on every instruction
// set. GCC 12 gives wrong warnings for xsimd's 64-bit shifts with AVX-512.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline constexpr int register_words = (PACKTRACE_LANES + 1) / 2;

/// Words of 64 bits; as many bits as the instruction set has in a register.
typedef std::uint64_t vbits __attribute__((vector_size(register_words * sizeof(std::uint64_t))));

inline vbits load_bits(const std::uint64_t* from)
{
    vbits x;
    __builtin_memcpy(&x, from, sizeof x);
    return x;
}

inline void store_bits(std::uint64_t* to, vbits x)
{
    __builtin_memcpy(to, &x, sizeof x);
}

// Bit planes from bytes: each 64-bit lane of 64 registers is a row of a bit matrix, which is
// transposed by exchanging blocks of halving size (Warren, Hacker's Delight, section 7-3).

inline constexpr int matrix_rows = 64;

// Cuts the bits of each lane into runs of `size` and swaps the odd runs of `a` with the even ones
// of `b`.
template <int size>
inline void exchange(vbits& a, vbits& b)
{
    constexpr std::uint64_t even = ~std::uint64_t{0} / ((std::uint64_t{1} << size) + 1);
    const vbits moved = ((a >> size) ^ b) & even;
    b = b ^ moved;
    a = a ^ (moved << size);
}

// Three of the six block sizes, from 4 * step down to step, over eight rows that are `step` apart
// and stay in registers.
template <int step>
inline void exchange_eight(std::uint64_t* first)
{
    vbits row[8];
    for (int i = 0; i < 8; ++i)
        row[i] = load_bits(first + i * step * register_words);
    for (int i = 0; i < 4; ++i)
        exchange<4 * step>(row[i], row[i + 4]);
    for (int i = 0; i < 4; ++i)
        exchange<2 * step>(row[i + i / 2 * 2], row[i + i / 2 * 2 + 2]);
    for (int i = 0; i < 4; ++i)
        exchange<step>(row[2 * i], row[2 * i + 1]);
    for (int i = 0; i < 8; ++i)
        store_bits(first + i * step * register_words, row[i]);
}

/// Transposes every lane's 64-by-64 matrix in place: bit q of row r becomes bit r of row q.
inline void transpose_bits(std::uint64_t* rows)
{
    for (int r = 0; r < 8; ++r)
        exchange_eight<8>(rows + r * register_words);
    for (int r = 0; r < matrix_rows; r += 8)
        exchange_eight<1>(rows + r * register_words);
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
