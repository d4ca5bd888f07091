// Ten lines to a picture.
#include <packtrace/build.hpp>
#include <packtrace/image_io.hpp>
#include <packtrace/render.hpp>

int main()
{
    packtrace::Scene scene = packtrace::make_scene();
    scene.camera.fov = 50;
    scene.objects = {packtrace::make_object(packtrace::sphere({0, 0, 5}, 1)),
                     packtrace::make_object(packtrace::plane({0, -1, 0}, {0, 1, 0}))};
    scene.objects[0].material.color = {1, 0.2, 0.1};
    scene.lights = {packtrace::ambient_light({0.2, 0.2, 0.2}),
                    packtrace::point_light({-3, 4, 0}, {0.8, 0.8, 0.8})};
    packtrace::write_image("picture.png", packtrace::render<float>(scene));
}
