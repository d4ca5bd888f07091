// A million rays at a thousand spheres, in double precision: what they hit, and proven bounds of
// where. million_rays.py does the same with NumPy, and prints the same.
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>

#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

namespace {

constexpr std::size_t edge = 1000;
constexpr std::size_t count = edge * edge;

/// Rays as arrays of their components, as RayScene takes them.
struct Rays {
    std::vector<double> org_x = std::vector<double>(count, 0.5);
    std::vector<double> org_y = std::vector<double>(count, 0.5);
    std::vector<double> org_z = std::vector<double>(count, -2.0);
    std::vector<double> dir_x = std::vector<double>(count);
    std::vector<double> dir_y = std::vector<double>(count);
    std::vector<double> dir_z = std::vector<double>(count, 4.0);
    std::vector<double> t_min = std::vector<double>(count, 0.0);
    std::vector<double> t_max = std::vector<double>(count, std::numeric_limits<double>::infinity());

    [[nodiscard]] packtrace::RaysView<double> view() const
    {
        return {org_x.data(), org_y.data(), org_z.data(), dir_x.data(), dir_y.data(),
                dir_z.data(), t_min.data(), t_max.data(), count};
    }
};

/// From one point through a square window.
Rays rays_through_window()
{
    Rays rays;
    for (std::size_t i = 0; i < count; ++i) {
        rays.dir_x[i] = static_cast<double>(i % edge) / 500.0 - 1.0;
        rays.dir_y[i] = static_cast<double>(i / edge) / 500.0 - 1.0;
    }
    return rays;
}

}  // namespace

int main()
{
    const packtrace::RayScene<double> scene(packtrace::generate_lattice({.edge = 10}));
    const Rays rays = rays_through_window();
    std::vector<double> t(count);
    std::vector<std::int32_t> object(count);
    scene.closest_hits(rays.view(), {.t = t.data(), .object = object.data()});

    std::size_t hits = 0;
    std::size_t first = 0;  // the ray that hits first
    for (std::size_t i = 0; i < count; ++i) {
        hits += object[i] >= 0;
        if (t[i] < t[first])
            first = i;
    }
    packtrace::RaysView<double> ray = rays.view();
    for (const double** component : {&ray.org_x, &ray.org_y, &ray.org_z, &ray.dir_x, &ray.dir_y,
                                     &ray.dir_z, &ray.t_min, &ray.t_max})
        *component += first;
    ray.count = 1;
    packtrace::HitBounds bounds;
    scene.bound_closest_hits(ray, &object[first], &bounds);
    std::printf("%zu of %zu rays hit\n", hits, count);
    std::printf("ray %zu hits object %d at t = %.17g, between %.17g and %.17g\n", first,
                object[first], t[first], bounds.low, bounds.high);
}
