#include "scene/scene_faults.hpp"
#include "scene/vectors.hpp"
#include <packtrace/animate.hpp>
#include <packtrace/validate.hpp>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

namespace packtrace {
namespace {

// The up vector of the scene's camera, so that a camera that already looks at the centre keeps its
// pose. If the view runs along it, the forward vector replaces it.
Vec3 upwards(const Camera& start, const Vec3& view)
{
    const Vec3& up = start.rotation[1];
    const bool along = glm::length(glm::cross(up, language::unit_vector(view))) < 1e-6;
    return along ? start.rotation[2] : up;
}

/// `start`, made to look at the orbit's centre, then rotated about its axis by `share` of the
/// orbit.
Camera orbit_camera(const Camera& start, const Orbit& orbit, double share)
{
    const Vec3 arm = start.position - orbit.center;
    const Vec3 axis = language::unit_vector(orbit.axis);
    const Mat3 turn(glm::rotate(Mat4(1.0), glm::radians(orbit.degrees * share), axis));
    Camera camera = start;
    camera.position = orbit.center + turn * arm;
    camera.rotation = turn * look_at(start.position, orbit.center, upwards(start, arm));
    return camera;
}

using Part = Vec3 CameraKey::*;

/// Change per frame from key `i` to the next.
Vec3 slope_after(std::span<const CameraKey> keys, std::size_t i, Part part)
{
    return (keys[i + 1].*part - keys[i].*part) /
           static_cast<double>(keys[i + 1].frame - keys[i].frame);
}

/// Change per frame at key `i`: the slope of the parabola through the key and its neighbours. At
/// the ends it is the slope of the straight line to the only neighbour.
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

/// The cubic Hermite curve from key `i` to the next, `u` in [0, 1].
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

/// The pose at `frame` on the curve through at least two keys in ascending frame order.
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

Camera key_camera(const Scene& scene, int frame)
{
    const CameraKey pose = pose_between(scene.animation->keys, frame);
    Camera camera = scene.camera;
    camera.position = pose.position;
    try {
        camera.rotation = look_at(pose.position, pose.look_at, pose.up);
    } catch (const std::invalid_argument&) {
        throw std::invalid_argument(
            "frame " + std::to_string(frame) +
            ": the way between the camera's keys leads through its look_at or straight along its "
            "up; add a key there");
    }
    return camera;
}

}  // namespace

Camera camera_at(const Scene& scene, int frame)
{
    if (!scene.animation)
        throw std::invalid_argument("the scene has no animation");
    const Animation& animation = *scene.animation;
    if (auto fault = language::fault_of_movement(scene))
        throw language::SceneFaultError(*std::move(fault));
    if (frame < 0 || frame >= animation.frames)
        throw std::invalid_argument("frame " + std::to_string(frame) +
                                    " is none of the animation's, 0.." +
                                    std::to_string(animation.frames - 1));
    if (animation.orbit)
        return orbit_camera(scene.camera, *animation.orbit,
                            static_cast<double>(frame) / animation.frames);
    return key_camera(scene, frame);
}

}  // namespace packtrace
