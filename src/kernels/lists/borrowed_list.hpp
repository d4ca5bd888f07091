#pragma once

#include <cstddef>

// A list in memory that belongs to others.
namespace packtrace::PACKTRACE_ISA {
namespace {

template <class Object>
struct BorrowedList {
    Object* first = nullptr;
    Object* last = nullptr;  ///< where the next one goes

    /// `room` is for as many objects as are ever in the list.
    void use(Object* room)
    {
        first = last = room;
    }
    template <class Arena>
    void take(Arena& arena, std::size_t room)
    {
        use(arena.template take<Object>(room));
    }
    /// One more, which the caller fills.
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
