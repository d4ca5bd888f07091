#pragma once

#include <algorithm>
#include <array>

namespace packtrace::reference {

/// The glass bodies a ray is inside, by object number, the last entered on top; each at most
/// once. A body that finds no room is left out, and its surface then bends nothing.
class GlassStack {
public:
    static constexpr int capacity = 8;
    static constexpr int outside = -1;

    /// The body whose glass the ray travels in, or `outside`.
    [[nodiscard]] int top() const
    {
        return depth_ > 0 ? bodies_[depth_ - 1] : outside;
    }
    [[nodiscard]] bool contains(int object) const
    {
        return std::find(bodies_.begin(), end(), object) != end();
    }
    [[nodiscard]] bool full() const
    {
        return depth_ == capacity;
    }
    void push(int object)
    {
        bodies_[depth_++] = object;
    }
    /// Takes out a body, wherever in the stack it is.
    void remove(int object)
    {
        depth_ = static_cast<std::size_t>(
            std::remove(bodies_.begin(), bodies_.begin() + static_cast<long>(depth_), object) -
            bodies_.begin());
    }

private:
    [[nodiscard]] std::array<int, capacity>::const_iterator end() const
    {
        return bodies_.begin() + static_cast<long>(depth_);
    }

    std::array<int, capacity> bodies_{};
    std::size_t depth_ = 0;
};

}  // namespace packtrace::reference
