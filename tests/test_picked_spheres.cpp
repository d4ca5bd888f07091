#include "catch.hpp"
#include "page_end.hpp"
#include "render/ray_columns.hpp"
#include "render_scene.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <random>
#include <span>
#include <vector>

// Coherent rays are tested together against a small set of candidate spheres, collected from the
// bvh. Their answers equal those of bvh traversal and of lists.
namespace packtrace::test {
namespace {

class SparseRandom {
public:
    explicit SparseRandom(unsigned seed) : random_(seed)
    {
    }
    double unit()
    {
        return unit_(random_);
    }
    Vec3 vector()
    {
        const double x = unit();
        const double y = unit();
        return {x, y, unit()};
    }

private:
    std::mt19937 random_;
    std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

/// Spheres of radius 0.01 to 0.6 around (0, 0, 6) over a ground.
Scene sparse_spheres(int count, unsigned seed, double reflective)
{
    SparseRandom random(seed);
    Scene scene;
    set_size(scene, 200, 150);
    const Material material = scratch(Rgb(0.5), 50, reflective);
    for (int i = 0; i < count; ++i)
        add_sphere(scene, Vec3(0, 0, 6) + 3.0 * random.vector(),
                   0.01 * std::pow(60.0, 0.5 + 0.5 * random.unit()), material);
    add_sphere(scene, {0, -5004, 0}, 5000, material);
    add_plane(scene, {0, 0, 30}, {0, 0.1, -1}, material);
    scene.lights = note_lights();
    return scene;
}

enum class Way { from_eye, to_light, from_light, parallel };

/// Chunks of coherent rays, each within `spread` of one direction. Every other chunk also has rays
/// beyond the range of the bounds, backward rays and rays without a direction.
template <class Real>
RayColumns<Real> running_together(Way way, double spread, unsigned seed)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    SparseRandom random(seed);
    RayColumns<Real> rays;
    Vec3 eye(0.0);
    Vec3 middle(0.0);
    for (int i = 0; i < 8 * 256 + 90; ++i) {
        if (i % 256 == 0) {
            eye = Vec3(0, 0, 6) + 9.0 * random.vector();
            middle = Vec3(0, 0, 6) + 3.0 * random.vector();
        }
        const Vec3 place = middle + 4.0 * spread * random.vector();
        Vec3 org = way == Way::to_light ? place : eye;
        Vec3 dir = way == Way::to_light ? eye - place : place - eye;
        if (way == Way::parallel) {
            org = eye + place - middle;
            dir = middle - eye;
        }
        const double t_min = way == Way::to_light ? 1e-4 : 0.0;
        double t_max = way == Way::to_light || way == Way::from_light ? 1.0 : infinity;
        if (i / 256 % 2 == 1 && i % 61 == 0) {
            switch (i / 61 % 8) {
                case 0:
                    dir.y = nan;
                    break;
                case 1:
                    t_max = 0.0;
                    break;
                case 2:
                    t_max = nan;
                    break;
                case 3:
                    org.y = -3e8;
                    break;
                case 4:
                    dir *= 1e-11;
                    break;
                case 5:
                    dir *= 1e11;
                    break;
                case 6:
                    org.x = 1e12;
                    break;
                default:
                    org.z = nan;
            }
        }
        rays.add(org, dir, t_min, t_max);
    }
    return rays;
}

template <class Real>
struct Answers {
    std::vector<Real> t;
    std::vector<std::int32_t> object;
    std::vector<std::uint8_t> mask;
};

/// The answers for all rays, in calls of this many rays.
template <class Real>
Answers<Real> answers(const RayScene<Real>& scene, const RayColumns<Real>& rays,
                      std::size_t at_once)
{
    Answers<Real> found;
    found.t.resize(rays.size());
    found.object.resize(rays.size());
    found.mask.resize(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += at_once) {
        const RaysView<Real> some = rays.view(first, std::min(at_once, rays.size() - first));
        scene.closest_hits(some, {found.t.data() + first, found.object.data() + first});
        scene.occluded(some, found.mask.data() + first);
    }
    return found;
}

/// For a miss, t is the end of the ray, which may be NaN.
template <class Real>
void check_same(const Answers<Real>& picked, const Answers<Real>& other)
{
    CHECK(different_bits(picked.t, other.t) == 0);
    CHECK(different_bits(picked.object, other.object) == 0);
    CHECK(different_bits(picked.mask, other.mask) == 0);
}

/// For calls with single rays and calls too small to collect candidates.
constexpr std::size_t in_one_call = 1u << 20;
constexpr std::size_t too_few_to_pick = 32;

template <class Real>
void check_rays(const Scene& scene, Way way, double spread, unsigned seed)
{
    const RayColumns<Real> rays = running_together<Real>(way, spread, seed);
    for (const std::string& isa : supported_isas()) {
        INFO(isa << ", way " << static_cast<int>(way) << ", spread " << spread);
        const RayScene<Real> by_tree(scene, {.isa = isa, .traversal = Traversal::tree});
        const RayScene<Real> by_lists(scene, {.isa = isa, .traversal = Traversal::list});
        const Answers<Real> picked = answers(by_tree, rays, in_one_call);
        check_same(picked, answers(by_tree, rays, too_few_to_pick));
        check_same(picked, answers(by_lists, rays, in_one_call));
        CHECK(std::count_if(picked.object.begin(), picked.object.end(),
                            [](std::int32_t object) { return object >= 0; }) > 100);
    }
}

}  // namespace

TEST_CASE("coherent rays have the answers of rays by themselves", "[picked_spheres]")
{
    unsigned seed = 0;
    for (const int count : {40, 300, 2000}) {
        const Scene scene = sparse_spheres(count, ++seed, 0.0);
        for (const Way way : {Way::from_eye, Way::to_light, Way::from_light, Way::parallel})
            for (const double spread : {0.003, 0.05, 0.4})
                check_rays<float>(scene, way, spread, ++seed);
    }
    check_rays<double>(sparse_spheres(300, 9, 0.0), Way::from_eye, 0.05, 9);
}

TEST_CASE("collecting candidate spheres reads nothing beyond the rays' arrays", "[picked_spheres]")
{
    const Scene scene = sparse_spheres(40, 3, 0.0);
    const RayColumns<float> rays = running_together<float>(Way::from_eye, 0.01, 3);
    for (const std::string& isa : supported_isas()) {
        const RayScene<float> by_tree(scene, {.isa = isa, .traversal = Traversal::tree});
        for (const std::size_t count : {65u, 67u, 100u, 255u}) {
            // A deque does not move its elements.
            std::deque<PageEnd<float>> column;
            for (const std::vector<float>& values : rays.columns)
                column.emplace_back(std::span(values).first(count));
            const auto at = [&](std::size_t i) { return column[i].data(); };
            const RaysView<float> view{at(0), at(1), at(2), at(3), at(4),
                                       at(5), at(6), at(7), count};
            Answers<float> found{std::vector<float>(count), std::vector<std::int32_t>(count),
                                 std::vector<std::uint8_t>(count)};
            by_tree.closest_hits(view, {found.t.data(), found.object.data()});
            by_tree.occluded(view, found.mask.data());
            RayColumns<float> some = rays;
            for (std::vector<float>& values : some.columns)
                values.resize(count);
            INFO(isa << ", " << count << " rays");
            check_same(found, answers(by_tree, some, too_few_to_pick));
        }
    }
}

TEST_CASE("a ray with a NaN does not affect the rays beside it", "[picked_spheres]")
{
    Scene scene;
    for (int i = 0; i < 64; ++i)
        add_sphere(scene, {3.0 * i, 0, 20}, 1, scratch(Rgb(0.5), -1, 0));
    constexpr std::size_t count = 64;
    constexpr std::size_t bad = 48;
    for (std::size_t column = 0; column < 8; ++column) {
        RayColumns<float> rays;
        for (std::size_t i = 0; i < count; ++i)
            rays.add({0, 0, 0}, {0, 0, 1}, 0, i % 8 == 0 ? 100 : 1);
        rays.columns[column][bad] = std::numeric_limits<float>::quiet_NaN();
        for (const std::string& isa : supported_isas()) {
            INFO(isa << ", column " << column);
            const RayScene<float> by_tree(scene, {.isa = isa, .traversal = Traversal::tree});
            const Answers<float> found = answers(by_tree, rays, in_one_call);
            for (std::size_t i = 0; i < count; ++i) {
                const bool hits = i % 8 == 0 && i != bad;
                CHECK(found.object[i] == (hits ? 0 : -1));
                CHECK(found.mask[i] == (hits ? 1 : 0));
            }
        }
    }
}

TEST_CASE("frames with candidate spheres have the pictures of lists", "[picked_spheres]")
{
    for (const int count : {30, 250, 1500})
        for (const double reflective : {0.0, 0.4}) {
            Scene scene = sparse_spheres(count, 21, reflective);
            // Some objects cast no shadow, so that shadow rays have their own bvh.
            if (count == 250)
                for (std::size_t i = 0; i < scene.objects.size(); i += 3)
                    scene.objects[i].casts_shadow = false;
            for (const std::string& isa : supported_isas()) {
                INFO(isa << ", " << count << " spheres");
                RenderOptions options{.isa = isa, .traversal = Traversal::list};
                const Image<float> by_lists = render<float>(scene, options);
                options.traversal = Traversal::tree;
                CHECK(render<float>(scene, options).rgb == by_lists.rgb);
            }
        }
}

TEST_CASE("small spheres far from the world's origin stay in the cones that contain them",
          "[picked_spheres]")
{
    for (const double offset : {3e5, 4e6}) {
        const Vec3 place(offset);
        SparseRandom random(5);
        Scene scene;
        set_size(scene, 128, 128);
        scene.camera.position = place;
        for (int i = 0; i < 60; ++i)
            add_sphere(scene, place + Vec3(0, 0, 3.5) + 1.5 * random.vector(),
                       0.08 + 0.07 * random.unit(), scratch(Rgb(0.1 + 0.01 * i), -1, 0));
        scene.lights = {Light{.type = LightType::ambient, .intensity = Rgb(1.0)}};
        for (const std::string& isa : supported_isas()) {
            INFO(isa << ", offset " << offset);
            RenderOptions options{.isa = isa, .traversal = Traversal::list};
            const Image<float> by_lists = render<float>(scene, options);
            options.traversal = Traversal::tree;
            CHECK(render<float>(scene, options).rgb == by_lists.rgb);
        }
    }
}

}  // namespace packtrace::test
