#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace packtrace {

/// At least `bytes` bytes, of any values, at a 64-byte boundary; in huge pages, where the system
/// has any, from the size of one on: a first look at each small page of a picture takes a quarter
/// of the time of a frame. Give back by std::free(). Throws std::bad_alloc.
[[nodiscard]] inline void* allocate_huge_pages(std::size_t bytes)
{
    constexpr std::size_t line = 64;
    constexpr std::size_t huge_page = std::size_t{1} << 21;
    const std::size_t boundary = bytes < huge_page ? line : huge_page;
    // Not up to the next huge page: what is left over is taken in small ones.
    const std::size_t whole = (bytes + line) / line * line;
    void* memory = nullptr;
    if (posix_memalign(&memory, boundary, whole) != 0)
        throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
    // A refusal costs time only.
    if (boundary == huge_page)
        (void)madvise(memory, whole, MADV_HUGEPAGE);
#endif
    return memory;
}

/// The allocator of large arrays. Elements that are given no value keep any.
template <class T>
struct HugePageAllocator {
    using value_type = T;

    HugePageAllocator() = default;
    template <class Other>
    HugePageAllocator(const HugePageAllocator<Other>&)
    {
    }

    [[nodiscard]] T* allocate(std::size_t count)
    {
        return static_cast<T*>(allocate_huge_pages(count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t)
    {
        std::free(memory);
    }

    template <class Element, class... Arguments>
    void construct(Element* at, Arguments&&... arguments)
    {
        if constexpr (sizeof...(Arguments) == 0)
            ::new (static_cast<void*>(at)) Element;
        else
            ::new (static_cast<void*>(at)) Element(std::forward<Arguments>(arguments)...);
    }

    friend bool operator==(const HugePageAllocator&, const HugePageAllocator&)
    {
        return true;
    }
};

}  // namespace packtrace
