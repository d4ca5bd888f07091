// A caller's rays that run apart, of which many miss, get the t that each of them gets alone, bit
// for bit: hits are refined in the company of others.
#include <cmath>
#include <cstring>
#include <limits>

#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>

#include "catch.hpp"
#include "few_objects.hpp"
#include "render_scene.hpp"

namespace packtrace::test {
namespace {

/// Rays in arrays, and room for answers.
struct RayArrays {
    std::vector<float> value[8];
    std::vector<float> t;
    std::vector<std::int32_t> object;

    void add(const Vec3& org, const Vec3& dir, float t_min, float t_max)
    {
        const double of_ray[8] = {org.x, org.y, org.z, dir.x, dir.y, dir.z, t_min, t_max};
        for (int i = 0; i < 8; ++i)
            value[i].push_back(static_cast<float>(of_ray[i]));
        t.push_back(0);
        object.push_back(0);
    }
    [[nodiscard]] RaysView<float> view(std::size_t first, std::size_t count) const
    {
        const auto at = [&](int i) { return value[i].data() + first; };
        return {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), count};
    }
    [[nodiscard]] HitsView<float> hits(std::size_t first)
    {
        return {t.data() + first, object.data() + first, {}, {}, {}};
    }
};

/// Most of them away from what the scene has in its middle; some with ends, some that are no rays.
RayArrays scattered_rays(unsigned seed, std::size_t count)
{
    SceneRandom random(seed);
    RayArrays rays;
    const double spread = std::pow(10.0, random.between(-1.0, 1.0));
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 org = spread * random.inside(Vec3(-2.0), Vec3(2.0));
        Vec3 dir = random.inside(Vec3(-1.0), Vec3(1.0));
        if (i % 3 == 0)
            dir = random.inside(Vec3(-1.0), Vec3(1.0)) - org;
        const float t_min = i % 5 == 1 ? 0.5f : 0.0f;
        const float t_max = i % 7 == 2 ? 3.0f : std::numeric_limits<float>::infinity();
        rays.add(org, i % 101 == 100 ? Vec3(std::nan("")) : dir, t_min, t_max);
    }
    return rays;
}

/// What rays leave that hit something, in arrays as well.
struct StartArrays {
    std::vector<float> point[3];
    std::vector<std::int32_t> surface;

    [[nodiscard]] StartsView<float> view(std::size_t first) const
    {
        return {{point[0].data() + first, point[1].data() + first, point[2].data() + first},
                surface.data() + first};
    }
};

/// Rays that leave what others hit, on either side, any way.
RayArrays leaving_rays(const RayScene<float>& queries, const RayArrays& rays, StartArrays& starts)
{
    SceneRandom random(3);
    RayArrays leaving;
    for (std::size_t i = 0; i < rays.t.size(); ++i) {
        SurfaceHit<float> hit;
        float place[3][3];
        std::int32_t surface = -1;
        queries.closest_hits(rays.view(i, 1), {&hit.t,
                                               &hit.object,
                                               &hit.normal[0],
                                               &hit.normal[1],
                                               &hit.normal[2],
                                               {&place[0][0], &place[0][1], &place[0][2]},
                                               {&place[1][0], &place[1][1], &place[1][2]},
                                               {&place[2][0], &place[2][1], &place[2][2]},
                                               &surface});
        if (hit.object < 0)
            continue;
        const bool inside = i % 4 == 3;
        const float(&org)[3] = place[inside ? 1 : 0];
        const Vec3 normal(hit.normal[0], hit.normal[1], hit.normal[2]);
        const Vec3 way = random.inside(Vec3(-1.0), Vec3(1.0));
        const bool outwards = glm::dot(way, normal) > 0.0;
        leaving.add(Vec3(org[0], org[1], org[2]), outwards != inside ? way : -way, 0.0f,
                    std::numeric_limits<float>::infinity());
        for (int axis = 0; axis < 3; ++axis)
            starts.point[axis].push_back(place[2][axis]);
        starts.surface.push_back(inside ? ~surface : surface);
    }
    return leaving;
}

/// The number of rays that hit anything.
std::size_t check_alone(const RayScene<float>& queries, RayArrays& rays,
                        const StartArrays* starts = nullptr)
{
    const auto ask = [&](std::size_t first, std::size_t count, const HitsView<float>& hits) {
        if (starts != nullptr)
            queries.closest_hits(rays.view(first, count), starts->view(first), hits);
        else
            queries.closest_hits(rays.view(first, count), hits);
    };
    const std::size_t count = rays.t.size();
    ask(0, count, rays.hits(0));
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
        float t = 0;
        std::int32_t object = 0;
        ask(i, 1, {&t, &object, {}, {}, {}});
        CAPTURE(i);
        REQUIRE(object == rays.object[i]);
        REQUIRE(std::memcmp(&t, &rays.t[i], sizeof t) == 0);
        found += object >= 0;
    }
    return found;
}

}  // namespace

TEST_CASE("rays that run apart get the t that each gets alone", "[pending_hits]")
{
    std::size_t found = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        const Scene scene = FewObjects(seed).scene;
        // Counts that leave packets and chunks open at their end.
        RayArrays rays = scattered_rays(seed, 200 + 37 * seed % 160);
        CAPTURE(seed);
        for (const std::string& isa : supported_isas()) {
            RenderOptions options;
            options.isa = isa;
            CAPTURE(isa);
            const RayScene<float> queries(scene, options);
            found += check_alone(queries, rays);
            StartArrays starts;
            RayArrays leaving = leaving_rays(queries, rays, starts);
            found += check_alone(queries, leaving, &starts);
        }
    }
    CHECK(found > 1000);
}

TEST_CASE("the same through a hierarchy, with other kinds beside its spheres", "[pending_hits]")
{
    Scene scene = generate_random_spheres({.count = 300, .radius = 0.4, .reflective = 0.0});
    std::size_t others = 0;
    for (const unsigned seed : {7u, 9u})
        for (const Object& object : FewObjects(seed).scene.objects) {
            scene.objects.push_back(object);
            others += !std::holds_alternative<Sphere>(object.surface);
        }
    REQUIRE(others > 1);
    // Compilers choose the order in which a scene's random numbers are taken: of these rays about a
    // thousand hit it either way.
    RayArrays rays = scattered_rays(4, 1500);
    for (const std::string& isa : supported_isas()) {
        RenderOptions options;
        options.isa = isa;
        options.traversal = Traversal::tree;
        CAPTURE(isa);
        const RayScene<float> queries(scene, options);
        const std::size_t found = check_alone(queries, rays);
        CHECK(found > 300);
        CHECK(found < 1400);
        StartArrays starts;
        RayArrays leaving = leaving_rays(queries, rays, starts);
        CHECK(check_alone(queries, leaving, &starts) > 100);
    }
}

}  // namespace packtrace::test
