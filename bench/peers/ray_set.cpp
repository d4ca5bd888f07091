#include "ray_set.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace packtrace::peers {
namespace {

/// The even bits of a number below 256, joined.
int even_bits(std::size_t number)
{
    int bits = 0;
    for (unsigned bit = 0; bit < 4; ++bit)
        bits |= static_cast<int>((number >> (2 * bit)) & 1u) << bit;
    return bits;
}

/// A number in [0, 1) for each counter.
double random_unit(std::uint64_t counter)
{
    std::uint64_t bits = (counter + 1) * 0x9E3779B97F4A7C15u;
    bits = (bits ^ (bits >> 30u)) * 0xBF58476D1CE4E5B9u;
    bits = (bits ^ (bits >> 27u)) * 0x94D049BB133111EBu;
    return static_cast<double>((bits ^ (bits >> 31u)) >> 11u) * 0x1p-53;
}

Vec3 cosine_direction(const Vec3& normal, std::uint64_t counter)
{
    const double square = random_unit(2 * counter);
    const double angle = 2.0 * std::numbers::pi * random_unit(2 * counter + 1);
    const Vec3 other = std::abs(normal.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = glm::normalize(glm::cross(normal, other));
    const Vec3 v = glm::cross(normal, u);
    return std::sqrt(square) * (std::cos(angle) * u + std::sin(angle) * v) +
           std::sqrt(1.0 - square) * normal;
}

Vec3 at(const std::vector<float> (&components)[3], std::size_t i)
{
    return {components[0][i], components[1][i], components[2][i]};
}

}  // namespace

void RaySet::add(const Vec3& origin, const Vec3& direction, double longest)
{
    for (int axis = 0; axis < 3; ++axis) {
        org[axis].push_back(static_cast<float>(origin[axis]));
        dir[axis].push_back(static_cast<float>(direction[axis]));
    }
    t_min.push_back(0.0F);
    t_max.push_back(static_cast<float>(longest));
}

RaysView<float> RaySet::view(std::size_t first, std::size_t count) const
{
    return {org[0].data() + first, org[1].data() + first, org[2].data() + first,
            dir[0].data() + first, dir[1].data() + first, dir[2].data() + first,
            t_min.data() + first,  t_max.data() + first,  count};
}

void RaySet::copy(const RaySet& others, std::size_t first, std::size_t count)
{
    const auto part = [&](std::vector<float>& to, const std::vector<float>& from) {
        const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
        to.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        part(org[axis], others.org[axis]);
        part(dir[axis], others.dir[axis]);
    }
    part(t_min, others.t_min);
    part(t_max, others.t_max);
}

RaySet camera_rays(const Scene& scene)
{
    const CameraBasis basis = camera_basis(scene.camera, scene.width, scene.height);
    const Vec2 sample = scene.camera.pixel_sample;
    RaySet rays;
    for (int tile_y = 0; tile_y < scene.height; tile_y += tile_size)
        for (int tile_x = 0; tile_x < scene.width; tile_x += tile_size)
            for (std::size_t i = 0; i < tile_pixels; ++i) {
                const double x = tile_x + even_bits(i) + sample.x - 0.5 * scene.width;
                const double y = 0.5 * scene.height - (tile_y + even_bits(i >> 1u)) - sample.y;
                rays.add(basis.origin, basis.forward + x * basis.right + y * basis.up,
                         std::numeric_limits<double>::infinity());
            }
    return rays;
}

std::vector<SurfacePoint> hit_points(const Scene& scene, const RaySet& rays, const Hits& hits)
{
    std::vector<SurfacePoint> points;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits.object[i] < 0)
            continue;
        const auto& object = scene.objects[static_cast<std::size_t>(hits.object[i])];
        const auto& sphere = std::get<Sphere>(object.surface);
        const double t = true_distance(rays, i, sphere);
        if (!std::isfinite(t))
            continue;
        const Vec3 normal = glm::normalize(at(rays.org, i) + t * at(rays.dir, i) - sphere.center);
        points.push_back(
            {sphere.center + sphere.radius * normal, normal, 1e-3 * std::min(1.0, sphere.radius)});
    }
    return points;
}

RaySet shadow_rays(const std::vector<SurfacePoint>& points, const Vec3& light, ShadowEnd start)
{
    RaySet rays;
    for (const SurfacePoint& point : points) {
        const Vec3 above = point.position + point.offset * point.normal;
        if (start == ShadowEnd::light)
            rays.add(light, above - light, 1.0);
        else
            rays.add(above, light - above, 1.0);
    }
    return rays;
}

RaySet bounce_rays(const std::vector<SurfacePoint>& points)
{
    RaySet rays;
    for (std::size_t i = 0; i < points.size(); ++i)
        rays.add(points[i].position + points[i].offset * points[i].normal,
                 cosine_direction(points[i].normal, i), std::numeric_limits<double>::infinity());
    return rays;
}

double true_distance(const RaySet& rays, std::size_t ray, const Sphere& sphere)
{
    const Vec3 way = sphere.center - at(rays.org, ray);
    const Vec3 dir = at(rays.dir, ray);
    const double a = glm::dot(dir, dir);
    const double b = glm::dot(way, dir);
    const Vec3 cross = glm::cross(way, dir);
    const double discriminant = sphere.radius * sphere.radius * a - glm::dot(cross, cross);
    if (discriminant < 0.0)
        return std::numeric_limits<double>::infinity();
    const double root = std::sqrt(discriminant);
    for (const double t : {(b - root) / a, (b + root) / a})
        if (t > rays.t_min[ray] && t < rays.t_max[ray])
            return t;
    return std::numeric_limits<double>::infinity();
}

}  // namespace packtrace::peers
