#pragma once

#include "kernels/simd/lanes.hpp"

#include <cstdint>

// Tables that move the chosen lanes of a register to its front.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// For every choice of `Lanes` lanes, the lane numbers chosen, in order, each spread over
/// `Parts` consecutive parts of a lane; the rest repeats part 0.
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
