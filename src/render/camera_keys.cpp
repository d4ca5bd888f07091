#include "render/camera_keys.hpp"

#include <algorithm>
#include <cstddef>

namespace packtrace {
namespace {

using Part = Vec3 CameraKey::*;

/// Change per frame from key `i` to the next.
Vec3 slope_after(std::span<const CameraKey> keys, std::size_t i, Part part)
{
    return (keys[i + 1].*part - keys[i].*part) /
           static_cast<double>(keys[i + 1].frame - keys[i].frame);
}

/// Change per frame at key `i`: that of the parabola through it and its neighbours; at the ends
/// that of the straight line to the only neighbour.
Vec3 slope_at(std::span<const CameraKey> keys, std::size_t i, Part part)
{
    if (i == 0)
        return slope_after(keys, 0, part);
    const Vec3 before = slope_after(keys, i - 1, part);
    if (i + 1 == keys.size())
        return before;
    const Vec3 after = slope_after(keys, i, part);
    const double left = keys[i].frame - keys[i - 1].frame;
    const double right = keys[i + 1].frame - keys[i].frame;
    return (right * before + left * after) / (left + right);
}

/// Hermite's cubic from key `i` to the next, `u` in [0, 1].
Vec3 blend(std::span<const CameraKey> keys, std::size_t i, double u, Part part)
{
    const double frames = keys[i + 1].frame - keys[i].frame;
    const Vec3 from = keys[i].*part;
    const Vec3 way = keys[i + 1].*part - from;
    const Vec3 start = frames * slope_at(keys, i, part) - way;
    const Vec3 end = way - frames * slope_at(keys, i + 1, part);
    const double rest = 1.0 - u;
    return from + u * way + u * rest * (rest * start + u * end);
}

}  // namespace

CameraKey pose_between(std::span<const CameraKey> keys, int frame)
{
    if (frame <= keys.front().frame)
        return keys.front();
    if (frame >= keys.back().frame)
        return keys.back();
    const auto next =
        std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return key.frame > frame; });
    const std::size_t i = static_cast<std::size_t>(next - keys.begin()) - 1;
    const double u =
        static_cast<double>(frame - keys[i].frame) / (keys[i + 1].frame - keys[i].frame);
    CameraKey pose{frame, {}, {}, {}};
    for (const Part part : {&CameraKey::position, &CameraKey::look_at, &CameraKey::up})
        pose.*part = blend(keys, i, u, part);
    return pose;
}

}  // namespace packtrace
