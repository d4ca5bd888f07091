#pragma once

#include "bounds/bounded_scene.hpp"
#include <packtrace/scene.hpp>

#include <tbb/parallel_for.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

// The objects that an update of a RayScene moves.
namespace packtrace {

/// Throws std::invalid_argument unless the scene has as many objects as the RayScene.
inline void check_same_objects(std::size_t given, std::size_t held)
{
    if (given != held)
        throw std::invalid_argument("update: the scene has " + std::to_string(given) +
                                    " objects, the RayScene was made of " + std::to_string(held) +
                                    "; make a new RayScene");
}

/// Removes duplicates. Throws std::invalid_argument for a number that is not below `count`.
[[nodiscard]] inline std::vector<std::int32_t> distinct_objects(
    std::span<const std::int32_t> numbers, std::size_t count)
{
    std::vector<bool> seen(count);
    std::vector<std::int32_t> distinct;
    distinct.reserve(numbers.size());
    for (const std::int32_t number : numbers) {
        const auto place = static_cast<std::size_t>(number);
        if (number < 0 || place >= count)
            throw std::invalid_argument("update: no object has the number " +
                                        std::to_string(number) + "; there are " +
                                        std::to_string(count) + ", from 0 on");
        if (!seen[place])
            distinct.push_back(number);
        seen[place] = true;
    }
    return distinct;
}

/// The objects of `now` that differ from those of `before`. Both must have equally many objects.
[[nodiscard]] inline std::vector<std::int32_t> moved_objects(const bounds::BoundedScene& before,
                                                             const Scene& now)
{
    std::vector<std::uint8_t> has_moved(now.objects.size());
    tbb::parallel_for(std::size_t{0}, has_moved.size(), [&](std::size_t i) {
        has_moved[i] = before.holds(static_cast<std::int32_t>(i), now.objects[i]) ? 0 : 1;
    });
    std::vector<std::int32_t> moved;
    for (std::size_t i = 0; i < has_moved.size(); ++i)
        if (has_moved[i] != 0)
            moved.push_back(static_cast<std::int32_t>(i));
    return moved;
}

}  // namespace packtrace
