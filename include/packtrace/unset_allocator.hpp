#pragma once

#include <packtrace/export.hpp>

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <utility>

namespace packtrace {

/// Allocates `bytes` bytes, aligned to at least 64 bytes. From a quarter of a huge page (2 MiB) on
/// it uses huge pages, if the system has them, because the first touch of each page is slow. Throws
/// std::bad_alloc.
[[nodiscard]] PACKTRACE_API void* take_pages(std::size_t bytes);
/// Frees the memory of take_pages(). `memory` may be null.
PACKTRACE_API void return_pages(void* memory);

/// Does not initialise elements that are constructed without arguments. So the first touch of a
/// picture's memory, which is slow, is left to the threads that render the picture.
template <class T>
struct UnsetAllocator : std::allocator<T> {
    template <class Other>
    struct rebind {
        using other = UnsetAllocator<Other>;
    };

    UnsetAllocator() = default;
    template <class Other>
    UnsetAllocator(const UnsetAllocator<Other>&)
    {
    }

    [[nodiscard]] T* allocate(std::size_t count)
    {
        // On overflow take_pages() throws, because headers must compile with exceptions switched
        // off.
        constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
        return static_cast<T*>(take_pages(count > most / sizeof(T) ? most : count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t)
    {
        return_pages(memory);
    }

    template <class Element, class... Arguments>
    void construct(Element* at, Arguments&&... arguments)
    {
        if constexpr (sizeof...(Arguments) == 0)
            ::new (static_cast<void*>(at)) Element;
        else
            ::new (static_cast<void*>(at)) Element(std::forward<Arguments>(arguments)...);
    }
};

}  // namespace packtrace
