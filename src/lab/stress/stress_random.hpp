#pragma once

#include <packtrace/vec.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace packtrace::lab {

/// Random numbers that are the same with every compiler and library (SplitMix64, Steele, Lea, Flood
/// 2014).
class StressRandom {
public:
    explicit StressRandom(std::uint64_t seed) : state_(seed)
    {
    }

    [[nodiscard]] std::uint64_t bits()
    {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    [[nodiscard]] double between(double low, double high)
    {
        return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    }
    /// From `low` to `high` > 0, with a uniform logarithm.
    [[nodiscard]] double power(double low, double high)
    {
        return low * std::pow(high / low, between(0.0, 1.0));
    }
    /// An angle of a full turn, in radians.
    [[nodiscard]] double angle()
    {
        return between(0.0, 6.2831853);
    }
    [[nodiscard]] double sign()
    {
        return (bits() >> 63) != 0 ? 1.0 : -1.0;
    }
    [[nodiscard]] int below(int count)
    {
        return static_cast<int>((bits() >> 33) % static_cast<std::uint64_t>(count));
    }
    template <class Values>
    [[nodiscard]] const auto& pick(const Values& values)
    {
        return values[static_cast<std::size_t>(below(static_cast<int>(values.size())))];
    }
    [[nodiscard]] Vec3 box(double half)
    {
        const double x = between(-half, half);
        const double y = between(-half, half);
        const double z = between(-half, half);
        return {x, y, z};
    }
    [[nodiscard]] Vec3 unit()
    {
        for (;;) {
            const Vec3 v = box(1.0);
            const double length2 = v.x * v.x + v.y * v.y + v.z * v.z;
            if (length2 > 1e-2 && length2 <= 1.0)
                return v / std::sqrt(length2);
        }
    }

private:
    std::uint64_t state_;
};

}  // namespace packtrace::lab
