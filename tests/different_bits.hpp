#pragma once

#include <cstddef>
#include <cstring>

namespace packtrace::test {

/// How many elements of two lists of one length differ in any bit: NaN is what NaN is, and -0 not
/// 0.
template <class Elements>
[[nodiscard]] std::size_t different_bits(const Elements& a, const Elements& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::memcmp(&a[i], &b[i], sizeof(a[i])) != 0)
            ++count;
    return count;
}

}  // namespace packtrace::test
