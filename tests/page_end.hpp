#pragma once

#include "catch.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <sys/mman.h>
#include <unistd.h>
#include <vector>

namespace packtrace::test {

/// An array that ends exactly where an inaccessible memory page begins, so that a read beyond its
/// end crashes.
template <class T>
class PageEnd {
public:
    explicit PageEnd(std::size_t count)
        : count_(count), size_((count * sizeof(T) + page() - 1) / page() * page())
    {
        memory_ = mmap(nullptr, size_ + page(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS,
                       -1, 0);
        REQUIRE(memory_ != MAP_FAILED);
        REQUIRE(mprotect(bytes() + size_, page(), PROT_NONE) == 0);
    }
    explicit PageEnd(std::span<const T> values) : PageEnd(values.size())
    {
        std::copy(values.begin(), values.end(), data());
    }
    PageEnd(const PageEnd&) = delete;
    PageEnd& operator=(const PageEnd&) = delete;
    ~PageEnd()
    {
        munmap(memory_, size_ + page());
    }

    [[nodiscard]] T* data() const
    {
        return reinterpret_cast<T*>(bytes() + size_) - count_;
    }
    [[nodiscard]] std::vector<T> values() const
    {
        return {data(), data() + count_};
    }

private:
    static std::size_t page()
    {
        return static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    }
    [[nodiscard]] std::byte* bytes() const
    {
        return static_cast<std::byte*>(memory_);
    }

    std::size_t count_;
    std::size_t size_;
    void* memory_ = nullptr;
};

}  // namespace packtrace::test
