#pragma once

#include "kernel_abi/bvh.hpp"

#if PACKTRACE_LANES > 4
#include "kernels/native/child_order_avx2.hpp"
#else

#include "kernels/eight.hpp"

namespace packtrace::PACKTRACE_ISA {
namespace {

/// The children of a node that are met, the furthest first.
struct ChildOrder {
    std::int32_t slot[abi::node_width];
    int count = 0;

    ChildOrder(std::uint32_t met, Eight t_near)
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

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA

#endif
