#include <packtrace/animate.hpp>

#include <stdexcept>
#include <string>

#include "render/camera_keys.hpp"
#include "render/camera_orbit.hpp"

namespace packtrace {
namespace {

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
