#pragma once

#include <atomic>
#include <memory>

namespace packtrace {

/// Something that speeds up later work. It is made as soon as enough work was requested to pay for
/// it. Thread-safe: one thread makes it, while the others continue without it.
template <class Thing>
class MadeWhenPaid {
public:
    /// Adds `work` to the work requested so far. If the sum reaches `price`, calls `make()`, which
    /// returns a std::unique_ptr. Returns the thing, or null until it is made.
    template <class Make>
    const Thing* after(double work, double price, const Make& make)
    {
        if (const Thing* const thing = get())
            return thing;
        double asked = asked_.load(std::memory_order_relaxed);
        while (!asked_.compare_exchange_weak(asked, asked + work, std::memory_order_relaxed)) {
        }
        if (asked + work < price || making_.test_and_set())
            return nullptr;
        owner_ = make();
        thing_.store(owner_.get(), std::memory_order_release);
        return owner_.get();
    }

    /// Null until it is made.
    [[nodiscard]] const Thing* get() const
    {
        return thing_.load(std::memory_order_acquire);
    }

private:
    std::atomic<double> asked_{0.0};
    std::atomic_flag making_;
    std::unique_ptr<const Thing> owner_;
    std::atomic<const Thing*> thing_{nullptr};
};

}  // namespace packtrace
