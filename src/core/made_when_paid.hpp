#pragma once

#include <atomic>
#include <memory>

namespace packtrace {

/// Something that speeds up later work, made once so much work was asked for that it pays. Any
/// number of threads may ask: one makes it, the others meanwhile go on without.
template <class Thing>
class MadeWhenPaid {
public:
    /// Counts `work`; with all that was asked for before it may reach the price, for which
    /// `make()`, a std::unique_ptr, is called. Returns it, or null as long as it is not made.
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

    /// Null as long as it is not made.
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
