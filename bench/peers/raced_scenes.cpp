#include "raced_scenes.hpp"

#include <packtrace/generate.hpp>
#include <packtrace/read_scene.hpp>

#include <stdexcept>

namespace packtrace::peers {
namespace {

Scene made(const std::string& name)
{
    if (name == "four_spheres")
        return read_scene(PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene");
    if (name == "flake4")
        return generate_sphereflake({.depth = 4});
    if (name == "flake6")
        return generate_sphereflake({.depth = 6});
    if (name == "random1m")
        return generate_random_spheres();
    throw std::invalid_argument("there is no scene " + name);
}

}  // namespace

const std::vector<std::string>& scene_names()
{
    static const std::vector<std::string> names{"four_spheres", "flake4", "flake6", "random1m"};
    return names;
}

Scene raced_scene(const std::string& name, int size)
{
    Scene scene = made(name);
    scene.width = size;
    scene.height = size;
    return scene;
}

}  // namespace packtrace::peers
