#include <packtrace/build.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/renderer.hpp>

#include <vector>

// A source file compiled without exceptions, as in many games: it includes all headers that contain
// code. Exits with 0 if the picture and the ray are right.

int main()
{
    packtrace::Scene scene = packtrace::make_scene();
    scene.width = scene.height = 16;
    scene.objects = {packtrace::make_object(packtrace::sphere({0, 0, 5}, 1))};
    scene.lights = {packtrace::ambient_light(packtrace::Rgb(1))};
    packtrace::Image<float> image(2, 2);
    packtrace::Renderer<float>(scene).render(image);
    const auto converted = packtrace::convert<double>(image);

    const std::vector<double> zero{0};
    const std::vector<double> one{1};
    const std::vector<double> far{100};
    std::vector<double> t{0};
    std::vector<std::int32_t> object{-1};
    const packtrace::RaySpans<double> rays{zero, zero, zero, zero, zero, one, zero, far};
    packtrace::RayScene<double>(scene).closest_hits(
        rays.view(), packtrace::HitSpans<double>{t, object}.view(zero.size()));
    return converted.pixel(8, 8)[0] == 1 && t[0] == 4 && object[0] == 0 ? 0 : 1;
}
