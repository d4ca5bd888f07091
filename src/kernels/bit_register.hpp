#pragma once

#include <cstdint>

#include "kernels/isa.hpp"

// A register of bits. The compilers' own vector type knows & | ^ ~ << >> on every instruction
// set; GCC 12 warns wrongly of xsimd's 64-bit shifts for AVX-512.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline constexpr int register_words = PACKTRACE_LANES / 2;

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

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
