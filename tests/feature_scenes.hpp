#pragma once

#include "packet_scenes.hpp"
#include "scene_text.hpp"

#include <string>
#include <vector>

// Scenes that each use only a few features.
namespace packtrace::test {

inline const std::string small_view = "image_size = 80 x 60\nviewport_size = 1.3333 x 1\n";

inline const std::string one_light =
    "light { type = ambient intensity = 0.2 }\n"
    "light { type = point intensity = 0.8 position = (2, 3, -1) }\n";

inline const std::string two_balls =
    "sphere { center = (-0.6, 0, 4) radius = 1 color = (200, 80, 40) }\n"
    "sphere { center = (0.9, 0.4, 3) radius = 0.5 color = (40, 80, 200) }\n";

/// Two matt spheres under one light.
[[nodiscard]] inline Scene matt_scene()
{
    return parse(small_view + one_light + two_balls);
}

[[nodiscard]] inline std::vector<NamedScene> feature_scenes()
{
    const std::string floor =
        "plane { point = (0, -1, 0) normal = (0, 1, 0) checker = (255, 255, 255), (0, 0, 0), 1 }\n";
    const std::string shiny = "sphere { center = (0.1, 1.07, 5) radius = 1 specular = 40 }\n";
    const std::string mirror = "sphere { center = (0.1, 1.07, 5) radius = 1 reflective = 0.4 }\n";
    const std::string pipe =
        "cylinder { scale = (0.3, 0.3, 1) rotate = (1, 0, 0, 90) translate = (0, 0, 4)\n"
        "           z_range = (-1, 1) capped = true color = (90, 200, 90) }\n";
    const std::string general = "illumination = general\nmax_depth = 4\nshadows = transparent\n";
    const std::string tinted =
        "sphere { center = (0, 0, 4) radius = 1 diffuse = (0.2, 0.2, 0.2)\n"
        "         reflect = (0.9, 0.3, 0.1) }\n"
        "sphere { center = (1.6, 0.4, 5) radius = 1 diffuse = (0.5, 0.7, 0.9) }\n";
    const std::string glass =
        "sphere { center = (0, 0, 3) radius = 0.7 transmit = (0.8, 0.9, 0.8) ior = 1.5 }\n"
        "sphere { center = (0.8, 0.4, 5) radius = 1 diffuse = (0.5, 0.7, 0.9) }\n";
    return {
        {"matt", matt_scene()},
        {"ambient light alone",
         parse(small_view + "light { type = ambient intensity = 0.7 }\n" + two_balls + floor)},
        {"ambient light, no checker",
         parse(small_view + "light { type = ambient intensity = 0.7 }\n" + two_balls)},
        {"ambient light on a quadric",
         parse(small_view + "light { type = ambient intensity = 0.7 }\n" + pipe)},
        {"no shadows", parse(small_view + "shadows = none\n" + one_light + two_balls + floor)},
        {"checkers", parse(small_view + one_light + two_balls + floor)},
        {"highlights", parse(small_view + one_light + two_balls + shiny)},
        {"mirrors", parse(small_view + one_light + two_balls + mirror + floor)},
        {"mirrors at depth 0",
         parse(small_view + "max_depth = 0\n" + one_light + two_balls + mirror)},
        {"quadrics", parse(small_view + one_light + pipe)},
        {"tinted mirrors", parse(small_view + general + one_light + tinted)},
        {"glass", parse(small_view + general + one_light + glass)},
        {"glass at depth 0", parse(small_view +
                                   "illumination = general\nmax_depth = 0\nshadows = opaque\n"
                                   "depth_limit = background\nbackground = (80, 90, 200)\n" +
                                   one_light + glass)},
        {"a light that reaches everything",
         parse(small_view + two_balls + floor +
               "light { type = point intensity = 0.8 position = (2, 3, -1) casts_shadow = no }\n"
               "light { type = directional intensity = 0.3 direction = (-1, 2, -1) }\n")},
        {"an object without a shadow",
         parse(small_view + one_light + two_balls + floor +
               "sphere { center = (1, 1.6, 2.5) radius = 0.4 casts_shadow = no }\n")},
        {"no object with a shadow",
         parse(small_view + one_light +
               "sphere { center = (0, 0, 3) radius = 1 casts_shadow = no }\n"
               "sphere { center = (1, 1.6, 2.5) radius = 0.4 casts_shadow = no }\n")},
        {"a dark light and an object twice",
         parse(small_view + one_light + two_balls + two_balls +
               "light { type = point intensity = 0 position = (0, 9, 0) }\n")},
    };
}

/// More spheres than a list holds; every third casts no shadow.
[[nodiscard]] inline Scene forest_scene()
{
    Scene scene = random_spheres(400, 5);
    for (std::size_t i = 0; i < scene.objects.size(); i += 3)
        scene.objects[i].casts_shadow = false;
    return scene;
}

}  // namespace packtrace::test
