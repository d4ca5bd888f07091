#pragma once

#include <cstddef>

// A list in memory that it does not own.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Object>
struct BorrowedList {
    Object* first = nullptr;
    Object* last = nullptr;  ///< one past the last object

    /// Uses memory for the largest number of objects that the list ever holds.
    void use(Object* memory)
    {
        first = last = memory;
    }
    template <class Arena>
    void take(Arena& arena, std::size_t capacity)
    {
        use(arena.template take<Object>(capacity));
    }
    /// Appends an object, which the caller fills.
    Object& next()
    {
        return *last++;
    }
    [[nodiscard]] const Object* begin() const
    {
        return first;
    }
    [[nodiscard]] const Object* end() const
    {
        return last;
    }
    [[nodiscard]] bool empty() const
    {
        return first == last;
    }
    void clear()
    {
        last = first;
    }
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
