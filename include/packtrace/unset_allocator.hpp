#pragma once

#include <packtrace/export.hpp>

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <utility>

namespace packtrace {

/// Memory at a 64-byte boundary; in huge pages (2 MiB), where the system has any, from a quarter of
/// one on: the system takes its time for each page that is touched first. Throws std::bad_alloc.
[[nodiscard]] PACKTRACE_API void* take_pages(std::size_t bytes);
/// What take_pages() gave, or null.
PACKTRACE_API void return_pages(void* memory);

/// Gives no value to elements that are given none: the first to look at a picture's memory, which
/// the system takes its time for, are the threads that render it.
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
        // More than there can be is refused there, as headers have to compile where exceptions are
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
