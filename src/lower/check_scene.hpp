#pragma once

#include <cstddef>

#include <packtrace/scene.hpp>

// What no scene file can say but a scene built in code can, and what kernels would draw
// differently: all of them refuse it with one message.
namespace packtrace {

/// Object number `number` of the scene. Throws std::invalid_argument for numbers without a meaning:
/// a radius that is not above 0, a quadric whose coefficients are not those of its kind, a
/// transform that flattens; SceneError for a quadric without a surface.
void check_object(const Scene& scene, std::size_t number);

/// Throws std::invalid_argument for a light that shines from nowhere.
void check_lights(const Scene& scene);

/// Throws std::invalid_argument for a Scene::min_weight that is none.
void check_min_weight(const Scene& scene);

/// Lights, weight and all objects, on the threads of the TBB arena the call runs in. lower() checks
/// what it lowers by itself; this is for the scalar kernel.
void check_scene(const Scene& scene);

}  // namespace packtrace
