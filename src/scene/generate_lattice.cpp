#include <packtrace/generate.hpp>

#include "scene/generate_setting.hpp"

namespace packtrace {

Scene generate_lattice(const LatticeOptions& options)
{
    generators::check_option("edge", options.edge, 1, 215);
    generators::check_radius(options.radius);
    const Material material = generators::shiny("ball", {0.5, 0.8, 0.6}, options.reflective);
    Scene scene = generators::empty_scene({1.58, 1.31, -0.688}, Vec3(0.5), {0, 1, 0});
    scene.lights = generators::lamp_at({2.5, 2.5, -2});
    const double cell = 1.0 / options.edge;
    for (int z = 0; z < options.edge; ++z)
        for (int y = 0; y < options.edge; ++y)
            for (int x = 0; x < options.edge; ++x)
                generators::add_sphere(scene, cell * (Vec3(x, y, z) + 0.5), cell * options.radius,
                                       material);
    return scene;
}

}  // namespace packtrace
