#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>
#include <packtrace/version.hpp>

#include <iostream>
#include <string>

// An example program of a user of the library: a picture, a ray and an error. Exits with 0 if all
// three are right.

static_assert(PACKTRACE_VERSION_MAJOR == 0 && PACKTRACE_VERSION_MINOR >= 2);

namespace {

constexpr const char* scene_text = R"(
image_size = 16 x 16
sphere { center = (0, 0, 5)  radius = 1  color = (255, 0, 0) }
light { type = ambient  intensity = 1 }
)";

bool middle_is_red(const packtrace::Scene& scene)
{
    const packtrace::Image<float> image = packtrace::render<float>(scene);
    const float* pixel = image.pixel(8, 8);
    return pixel[0] > 0.9F && pixel[1] < 0.1F && pixel[2] < 0.1F;
}

bool ray_hits_at_4(const packtrace::Scene& scene)
{
    const packtrace::RayScene<double> rays(scene);
    const double zero = 0.0;
    const double one = 1.0;
    const double far = 100.0;
    double t = 0.0;
    std::int32_t object = -1;
    rays.closest_hits({&zero, &zero, &zero, &zero, &zero, &one, &zero, &far, 1},
                      {.t = &t, .object = &object});
    return t == 4.0 && object == 0;
}

/// An exception keeps its type across the boundary of a shared library.
bool wrong_scene_throws()
{
    try {
        (void)packtrace::parse_scene("sphere { radius = -1 }", "wrong");
    } catch (const packtrace::SceneError& error) {
        return std::string(error.what()).starts_with("wrong:1:");
    }
    return false;
}

}  // namespace

int main()
{
    const packtrace::Scene scene = packtrace::parse_scene(scene_text, "text");
    const bool right = middle_is_red(scene) && ray_hits_at_4(scene) && wrong_scene_throws();
    std::cout << "packtrace " PACKTRACE_VERSION_STRING << (right ? " works\n" : " fails\n");
    return right ? 0 : 1;
}
