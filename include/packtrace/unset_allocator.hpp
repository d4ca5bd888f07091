#pragma once

#include <memory>
#include <utility>

namespace packtrace {

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
