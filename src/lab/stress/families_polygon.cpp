#include "lab/stress/placed_quadric.hpp"
#include "lab/stress/stress_family.hpp"

#include <glm/geometric.hpp>

#include <cmath>

// Polygons: rays at shared edges, at corners, past notches and through holes.
namespace packtrace::lab {
namespace {

using Contour = std::vector<Vec3>;

Object polygon_object(std::vector<Contour> contours, const Mat4& transform)
{
    return {.surface = Polygon{std::move(contours)}, .transform = transform};
}

/// The six faces of |x|, |y|, |z| <= 1.
std::vector<Contour> cube_faces()
{
    std::vector<Contour> faces;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            Contour face;
            for (const auto& [u, v] :
                 {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
                Vec3 corner;
                corner[axis] = side;
                corner[(axis + 1) % 3] = side > 0 ? u : v;
                corner[(axis + 2) % 3] = side > 0 ? v : u;
                face.push_back(corner);
            }
            faces.push_back(face);
        }
    return faces;
}

/// A point of a contour: a corner once in four times, else any point of an edge.
Vec3 at_edge(StressRandom& r, const Contour& contour)
{
    const auto i = static_cast<std::size_t>(r.below(static_cast<int>(contour.size())));
    const Vec3& from = contour[i];
    const Vec3& to = contour[(i + 1) % contour.size()];
    return r.below(4) == 0 ? from : glm::mix(from, to, r.between(0.0, 1.0));
}

/// A ray at a placed contour, or past it by 1e-12 to 1e-2.
StressRay ray_at_edge(StressRandom& r, const Contour& contour, const Mat4& transform)
{
    const double off = r.below(4) == 0 ? 0.0 : r.power(1e-12, 1e-2);
    const Vec3 own = at_edge(r, contour) + off * r.unit();
    const Vec3 aim = to_world(transform, own);
    return ray_towards(aim + r.between(2.0, 6.0) * r.unit(), aim);
}

/// A cube of six polygons with shared edges.
StressCase polygon_cube(StressRandom& random)
{
    const Mat4 transform = any_placement(random, any_stretch(random, 0.3), random.box(2.0));
    const std::vector<Contour> faces = cube_faces();
    StressCase result;
    for (const Contour& face : faces)
        result.scene.objects.push_back(polygon_object({face}, transform));
    result.ray = [=](StressRandom& r) { return ray_at_edge(r, r.pick(faces), transform); };
    return result;
}

/// A star with a hole.
StressCase polygon_star(StressRandom& random)
{
    const Mat4 transform = any_placement(random, any_stretch(random, 0.3), random.box(2.0));
    std::vector<Contour> contours(2);
    constexpr double tenth = 0.62831853;
    for (int i = 0; i < 10; ++i) {
        const double radius = i % 2 == 0 ? 2.0 : 0.8;
        contours[0].emplace_back(radius * std::cos(tenth * i), radius * std::sin(tenth * i), 0.0);
    }
    for (int i = 0; i < 5; ++i)
        contours[1].emplace_back(0.4 * std::cos(2 * tenth * i), 0.4 * std::sin(2 * tenth * i), 0.0);
    StressCase result;
    result.scene.objects.push_back(polygon_object(contours, transform));
    result.ray = [=](StressRandom& r) { return ray_at_edge(r, r.pick(contours), transform); };
    return result;
}

/// Any point of a triangle.
Vec3 in_triangle(StressRandom& r, const Contour& corners)
{
    const double a = r.between(0.0, 1.0);
    const double b = r.between(0.0, 1.0 - a);
    return a * corners[0] + b * corners[1] + (1.0 - a - b) * corners[2];
}

/// Triangles so thin that the products of their normals cancel nearly completely.
StressCase polygon_sliver(StressRandom& random)
{
    const Vec3 from = random.box(2.0);
    const Vec3 along = random.between(0.5, 3.0) * random.unit();
    const Vec3 across = random.power(1e-6, 1e-2) * glm::cross(along, random.unit());
    const Contour corners = {from, from + along, from + random.between(0.1, 0.9) * along + across};
    StressCase result;
    result.scene.objects.push_back(polygon_object({corners}, Mat4(1.0)));
    result.ray = [=](StressRandom& r) {
        const Vec3 aim = in_triangle(r, corners);
        return ray_towards(aim + r.between(0.5, 6.0) * r.unit(), aim);
    };
    return result;
}

/// A triangle, and rays nearly in its plane.
StressCase polygon_edge_on(StressRandom& random)
{
    const Mat4 transform = any_placement(random, any_stretch(random, 0.3), random.box(2.0));
    const Contour corners = {{-1, -1, 0}, {1.5, -0.5, 0}, {0.2, 1.3, 0}};
    return case_of({polygon_object({corners}, transform)}, [=](StressRandom& r) {
        const Vec3 own = in_triangle(r, corners);
        const double turn = r.between(0.0, 6.283185307);
        const double up = r.power(1e-12, 1e-2);
        const Vec3 way = r.between(2.0, 6.0) * Vec3(std::cos(turn), std::sin(turn), up);
        return ray_towards(to_world(transform, own + way), to_world(transform, own));
    });
}

}  // namespace

std::vector<StressFamily> polygon_families()
{
    return {
        {"polygon-edges", "at the edges and corners that the six polygons of a cube share",
         polygon_cube},
        {"polygon-star", "at the outline of a star and of the hole in it", polygon_star},
        {"polygon-slivers", "triangles 1e-6 to 1e-2 of their length wide", polygon_sliver},
        {"polygon-edge-on", "nearly in a triangle's plane, sine 1e-12 to 1e-2", polygon_edge_on},
    };
}

}  // namespace packtrace::lab
