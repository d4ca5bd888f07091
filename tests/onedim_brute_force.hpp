#pragma once

#include <packtrace/onedim.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace packtrace::test {

/// Tries every assignment of None, Medium, All to the rays of a small system and checks the note's
/// equations one by one. It shares no code with the solvers.
class BruteForce {
public:
    static constexpr std::size_t most_surfaces = 4;

    explicit BruteForce(std::span<const onedim::Surface> system) : system_(system)
    {
        const std::size_t unknowns = 2 * system.size();
        do {
            if (solves())
                keep();
        } while (next(unknowns));
        rays_ = least_;
        least_solves_ = found_ && solves();
    }

    /// Whether the minimum of every ray over all solutions is itself a solution.
    [[nodiscard]] bool has_least_solution() const
    {
        return least_solves_;
    }
    [[nodiscard]] onedim::Intensity darkest() const
    {
        return static_cast<onedim::Intensity>(left(least_, 0));
    }
    [[nodiscard]] onedim::Intensity brightest() const
    {
        return static_cast<onedim::Intensity>(brightest_);
    }

private:
    // L0 … L(n-1), then R1 … Rn, as 0, 1, 2.
    using Assignment = std::array<int, 2 * most_surfaces>;

    static int plus(int a, int b)
    {
        return std::min(a + b, 2);
    }
    static int times(int a, int b)
    {
        return std::min(a, b);
    }

    [[nodiscard]] int left(const Assignment& rays, std::size_t i) const
    {
        return i == system_.size() ? 0 : rays[i];
    }
    [[nodiscard]] int right(const Assignment& rays, std::size_t i) const
    {
        return i == 0 ? 0 : rays[system_.size() + i - 1];
    }

    [[nodiscard]] static int shine(const onedim::Surface& s, int in_front, int behind)
    {
        const int reflected = times(static_cast<int>(s.reflectance), in_front);
        const int transmitted = times(static_cast<int>(s.translucence), behind);
        return plus(plus(reflected, transmitted), static_cast<int>(s.emission));
    }

    [[nodiscard]] bool solves() const
    {
        for (std::size_t i = 0; i < system_.size(); ++i) {
            const onedim::Surface& s = system_[i];
            const bool towards = s.direction == onedim::Direction::towards;
            const int near_right = right(rays_, i);
            const int far_left = left(rays_, i + 1);
            if (left(rays_, i) != (towards ? shine(s, near_right, far_left) : far_left))
                return false;
            if (right(rays_, i + 1) != (towards ? near_right : shine(s, far_left, near_right)))
                return false;
        }
        return true;
    }

    void keep()
    {
        for (std::size_t i = 0; i < least_.size(); ++i)
            least_[i] = found_ ? std::min(least_[i], rays_[i]) : rays_[i];
        brightest_ = std::max(brightest_, left(rays_, 0));
        found_ = true;
    }

    // Counts through the assignments as numbers in base 3; false after the last.
    bool next(std::size_t unknowns)
    {
        for (std::size_t i = 0; i < unknowns; ++i) {
            if (++rays_[i] < 3)
                return true;
            rays_[i] = 0;
        }
        return false;
    }

    std::span<const onedim::Surface> system_;
    Assignment rays_{};
    Assignment least_{};
    int brightest_ = 0;
    bool found_ = false;
    bool least_solves_ = false;
};

}  // namespace packtrace::test
