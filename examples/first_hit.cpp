// Ten lines to a first hit: where a ray meets a ball, and between which numbers that surely lies.
#include <packtrace/build.hpp>
#include <packtrace/intersect.hpp>

#include <cstdio>

int main()
{
    packtrace::Scene scene = packtrace::make_scene();
    scene.objects = {packtrace::make_object(packtrace::sphere({0, 0, 5}, 1))};
    const packtrace::RayScene<float> rays(scene);
    const packtrace::Ray<float> ray = {.org = {0, 0, 0}, .dir = {0.1F, 0, 1}};
    const packtrace::SurfaceHit<float> hit = rays.closest_hit(ray);
    const packtrace::HitBounds bounds = rays.bound_closest_hit(ray, hit.object);
    std::printf("object %d at t = %.9g, proven to lie in [%.17g, %.17g]\n", hit.object,
                static_cast<double>(hit.t), bounds.low, bounds.high);
}
