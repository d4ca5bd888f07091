#pragma once

#include <chrono>

namespace packtrace::peers {

/// The sum of several measured times.
class PassTimer {
public:
    template <class Work>
    void measure(Work work)
    {
        const auto start = std::chrono::steady_clock::now();
        work();
        total_ += std::chrono::steady_clock::now() - start;
    }
    [[nodiscard]] double seconds() const
    {
        return std::chrono::duration<double>(total_).count();
    }

private:
    std::chrono::steady_clock::duration total_{};
};

}  // namespace packtrace::peers
