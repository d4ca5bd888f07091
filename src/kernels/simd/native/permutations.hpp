#pragma once

#include "kernels/simd/lanes.hpp"

#include <cstdint>

// Tables of permutations that move chosen lanes to the front of a register.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// For every set of chosen lanes out of `Lanes`: the chosen lane numbers in order, each as `Parts`
/// consecutive parts of a lane. The remaining entries are 0.
template <int Lanes, int Parts>
struct CompressTable {
    alignas(64) std::uint8_t part[1 << Lanes][static_cast<std::size_t>(Lanes * Parts)] = {};

    constexpr CompressTable()
    {
        for (int choice = 0; choice < (1 << Lanes); ++choice) {
            int next = 0;
            for (int lane = 0; lane < Lanes; ++lane) {
                if (!((choice >> lane) & 1))
                    continue;
                for (int p = 0; p < Parts; ++p)
                    part[choice][next++] = static_cast<std::uint8_t>(lane * Parts + p);
            }
        }
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
