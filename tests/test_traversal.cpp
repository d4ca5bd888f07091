#include "catch.hpp"
#include "lower/packed_scene.hpp"
#include "lower/tree_objects.hpp"
#include "render/ray_columns.hpp"
#include "render_scene.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"
#include <packtrace/build.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/renderer.hpp>
#include <packtrace/traversal.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

// Traversal of a bvh by interval frusta, cells or single rays gives the same hits as lists: t and
// object agree bit for bit.
namespace packtrace::test {
namespace {

Quadric quadric_of(int which)
{
    Quadric quadric;
    switch (which % 3) {
        case 0:
            quadric.kind = QuadricKind::cylinder;
            quadric.coefficients = {1, 1, 0, 0, 0, 0, 0, 0, 0, -1};
            break;
        case 1:
            quadric.kind = QuadricKind::cone;
            quadric.coefficients = {1, 1, -1, 0, 0, 0, 0, 0, 0, 0};
            break;
        default:
            quadric.kind = QuadricKind::ellipsoid;
            quadric.coefficients = {1, 1, 1, 0, 0, 0, 0, 0, 0, -1};
            return quadric;
    }
    quadric.z_range = ZRange{-1.0, 0.7};
    quadric.capped = which % 2 == 0;
    return quadric;
}

/// Objects of all kinds in a ball around (0, 0, 6): overlapping, inside each other, some twice.
Scene mixed_scene(int count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto place = [&] {
        const double x = 3.0 * unit(random);
        const double y = 3.0 * unit(random);
        return Vec3(x, y, 6.0 + 3.0 * unit(random));
    };
    Scene scene;
    set_size(scene, 70, 50);
    scene.lights = note_lights();
    const Material material = scratch(Rgb(0.5), 50, 0.3);
    for (int i = 0; i < count; ++i) {
        const Vec3 center = place();
        const double radius = std::pow(10.0, -0.5 + 0.8 * unit(random));
        if (i % 4 == 3) {
            add_object(scene, quadric_of(i / 4), material);
            scene.objects.back().transform = glm::scale(
                glm::rotate(glm::translate(Mat4(1.0), center), 3.0 * unit(random), Vec3(1, 2, 3)),
                Vec3(radius, 0.5 * radius, 2.0 * radius));
        } else {
            add_sphere(scene, i % 7 == 0 ? Vec3(0, 0, 6) : center, i % 7 == 0 ? 0.5 : radius,
                       material);
        }
    }
    add_sphere(scene, {0, -5004, 0}, 5000, material);
    add_plane(scene, {0, 6, 0}, {0.1, -1, 0}, material);
    return scene;
}

/// Rays in runs of 64: from a point, parallel, along an axis, and in all directions. Their
/// directions have any length; they start inside and far away, some end early, and a few are
/// invalid.
template <class Real>
RayColumns<Real> many_rays(int count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto vector = [&] {
        const double x = unit(random);
        const double y = unit(random);
        return Vec3(x, y, unit(random));
    };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    RayColumns<Real> rays;
    Vec3 origin(0.0);
    Vec3 way(0.0, 0.0, 1.0);
    for (int i = 0; i < count; ++i) {
        const int run = i / 64 % 4;
        if (i % 64 == 0) {
            origin = Vec3(0, 0, 6) + (i / 64 % 5 == 0 ? 400.0 : 5.0) * vector();
            way = Vec3(0, 0, 6) - origin + vector();
        }
        const Vec3 org = run == 1 ? origin + 0.3 * vector() : origin;
        Vec3 dir = run == 1 ? way : way + 0.05 * glm::length(way) * vector();
        if (run == 2)
            dir = Vec3(i / 256 % 2, (i / 256 + 1) % 2, 0);
        if (run == 3)
            dir = std::pow(10.0, 4.0 * unit(random)) * vector();
        if (i % 501 == 500)
            dir.y = std::numeric_limits<double>::quiet_NaN();
        rays.add(org, dir, i % 9 ? 0 : 0.1, i % 5 ? infinity : 1.0);
    }
    return rays;
}

template <class Real>
struct Results {
    std::vector<Real> t;
    std::vector<std::int32_t> object;
    std::vector<std::uint8_t> mask;
    std::size_t hits = 0;
    std::vector<Real> all_t;  ///< of all hits of the first ray, then of the next
};

template <class Real>
Results<Real> trace(const Scene& scene, const RayColumns<Real>& rays, RenderOptions options,
                    Traversal traversal)
{
    options.traversal = traversal;
    const RayScene<Real> traced(scene, options);
    Results<Real> results;
    results.t.resize(rays.size());
    results.object.resize(rays.size());
    results.mask.resize(rays.size());
    traced.closest_hits(rays.view(), {results.t.data(), results.object.data()});
    traced.occluded(rays.view(), results.mask.data());
    traced.all_hits(rays.view(), [&](std::size_t, std::span<const SurfaceHit<Real>> hits) {
        for (const auto& hit : hits)
            results.all_t.push_back(hit.t);
    });
    for (const std::int32_t object : results.object)
        results.hits += object >= 0 ? 1 : 0;
    return results;
}

template <class Real>
void compare_results(const Results<Real>& list, const Results<Real>& tree)
{
    CHECK(list.hits > list.t.size() / 20);
    CHECK(different_bits(list.t, tree.t) == 0);
    CHECK(different_bits(list.object, tree.object) == 0);
    CHECK(different_bits(list.mask, tree.mask) == 0);
    CHECK(different_bits(list.all_t, tree.all_t) == 0);
}

template <class Real>
void compare_traversals(const Scene& scene, const RayColumns<Real>& rays,
                        const RenderOptions& options)
{
    compare_results(trace(scene, rays, options, Traversal::list),
                    trace(scene, rays, options, Traversal::tree));
}

template <class Real>
struct Frame {
    Image<Real> picture;
    FrameCounts counts;
};

template <class Real>
Frame<Real> frame_of(const Scene& scene, RenderOptions options, Traversal traversal)
{
    options.traversal = traversal;
    Frame<Real> frame;
    frame.counts = Renderer<Real>(scene, options).render(frame.picture);
    return frame;
}

template <class Real>
void compare_frames(const Frame<Real>& list, const Frame<Real>& tree)
{
    CHECK(different_bits(list.picture.rgb, tree.picture.rgb) == 0);
    CHECK(list.counts.shadow == tree.counts.shadow);
    CHECK(list.counts.reflected == tree.counts.reflected);
    CHECK(list.counts.reflected > 0);
}

/// Compares lists on one instruction set with bvhs on all of `isas`, which give the same bits.
template <class Real>
void compare_with_lists(const Scene& scene, int rays, unsigned seed, RenderOptions options,
                        const std::vector<std::string>& isas, const std::string& isa_of_lists)
{
    options.isa = isa_of_lists;
    const RayColumns<Real> columns = many_rays<Real>(rays, seed);
    const Results<Real> list = trace(scene, columns, options, Traversal::list);
    const Frame<Real> frame = frame_of<Real>(scene, options, Traversal::list);
    for (const std::string& isa : isas) {
        INFO("hierarchies by " << isa << ", lists by " << isa_of_lists);
        options.isa = isa;
        compare_results(list, trace(scene, columns, options, Traversal::tree));
        compare_frames(frame, frame_of<Real>(scene, options, Traversal::tree));
    }
}

/// Lists take several times as long as bvhs, so each scene runs them on one instruction set only.
void compare_on_every_isa(int scenes, int rays, unsigned seed)
{
    std::vector<std::string> others = supported_isas();
    std::erase_if(others, [](const std::string& isa) {
        const std::vector<std::string> fused = fused_isas();
        return std::find(fused.begin(), fused.end(), isa) != fused.end();
    });
    for (const std::vector<std::string>& isas : {fused_isas(), others}) {
        const int count = static_cast<int>(isas.size());
        for (int i = 0; i < scenes && count > 0; ++i) {
            const int objects = 3 + (i * 37) % 190;
            INFO("scene " << i << ", " << objects << " objects");
            const unsigned number = seed + static_cast<unsigned>(i);
            const Scene scene = mixed_scene(objects, number);
            const RenderOptions options{.accuracy = i % 2 == 0 ? Accuracy::fast : Accuracy::exact};
            // Each instruction set has its turn in either accuracy.
            const std::string& turn = isas[static_cast<std::size_t>((i + i / count) % count)];
            compare_with_lists<float>(scene, rays, number, options, isas, turn);
            compare_with_lists<double>(scene, rays, number, options, isas, turn);
        }
    }
}

}  // namespace

TEST_CASE("frames of wide packets use lists up to more objects than those of narrow packets",
          "[traversal]")
{
    const auto chosen = [](int objects, int lanes) {
        return frame_traversal(lower(random_spheres(objects, 1)), Traversal::automatic, lanes);
    };
    for (const int lanes : {2, 4, 8, 16}) {
        CHECK(chosen(80, lanes) == Traversal::list);
        CHECK(chosen(300, lanes) == Traversal::tree);
    }
    // results/crossover.json: frames by a bvh win from 72 to 256 spheres on with 16 lanes, and from
    // 63 to 224 with 4, depending on the scene.
    CHECK(chosen(140, 4) == Traversal::tree);
    CHECK(chosen(140, 16) == Traversal::list);
    const LoweredScene few = lower(random_spheres(5, 1));
    CHECK(frame_traversal(few, Traversal::tree, 16) == Traversal::tree);
    CHECK(frame_traversal(lower(random_spheres(600, 1)), Traversal::list, 4) == Traversal::list);
}

TEST_CASE("exact frames without mirrors or glass use lists up to the most objects", "[traversal]")
{
    const auto chosen = [](const Scene& scene, Accuracy accuracy) {
        return frame_traversal(lower(scene, accuracy), Traversal::automatic, 8);
    };
    const auto matt_spheres = [](int count) {
        Scene scene = random_spheres(count, 1);
        for (Object& object : scene.objects)
            object.material = scratch(Rgb(0.5), 100.0, 0.0);
        return scene;
    };
    CHECK(chosen(matt_spheres(380), Accuracy::exact) == Traversal::list);
    CHECK(chosen(matt_spheres(390), Accuracy::exact) == Traversal::tree);
    CHECK(chosen(matt_spheres(380), Accuracy::fast) == Traversal::tree);
    // In fast mode matt scenes switch to the bvh at fewer objects than scenes with incoherent
    // mirrored rays.
    CHECK(chosen(matt_spheres(108), Accuracy::fast) == Traversal::list);
    CHECK(chosen(matt_spheres(116), Accuracy::fast) == Traversal::tree);
    CHECK(chosen(random_spheres(116, 1), Accuracy::fast) == Traversal::list);
    // No ray is mirrored at depth 0.
    Scene mirrors = random_spheres(380, 1);
    CHECK(chosen(mirrors, Accuracy::exact) == Traversal::tree);
    mirrors.max_depth = 0;
    CHECK(chosen(mirrors, Accuracy::exact) == Traversal::list);
    // A polygon counts as four objects.
    Scene with_polygons = matt_spheres(200);
    const auto add_triangle = [&](double z) {
        const std::vector<Vec3> corners = {{0, 0, z}, {1, 0, z}, {0, 1, z}};
        with_polygons.objects.push_back(make_object(Polygon{{corners}}, {}));
    };
    for (int i = 0; i < 45; ++i)
        add_triangle(5.0 + i);
    CHECK(chosen(with_polygons, Accuracy::exact) == Traversal::list);
    add_triangle(4.0);
    CHECK(chosen(with_polygons, Accuracy::exact) == Traversal::tree);
}

TEST_CASE("lists and bvhs give the same hits and pictures", "[traversal]")
{
    compare_on_every_isa(4, 3000, 1);
}

namespace {

/// Small quadrics and triangles in a ball around (0, 0, 6), and a mirror that shows them.
Scene quadrics_and_polygons(int count)
{
    Scene scene = mixed_scene(0, 1);
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < count; ++i) {
        const Vec3 center(3.0 * unit(random), 3.0 * unit(random), 6.0 + 3.0 * unit(random));
        if (i % 3 == 0)
            add_object(scene, Polygon{{{{0, 0, 0}, {1, 0, 0.2}, {0, 1, 0.1}}}},
                       scratch(Rgb(0.5), 50, 0.3));
        else
            add_object(scene, quadric_of(i), scratch(Rgb(0.2), 50, 0.3));
        const Mat4 turned =
            glm::rotate(glm::translate(Mat4(1.0), center), 3.0 * unit(random), Vec3(1, 2, 3));
        scene.objects.back().transform = glm::scale(turned, Vec3(0.2, 0.1, 0.3));
    }
    return scene;
}

}  // namespace

TEST_CASE("more quadrics and polygons than the bvh keeps bounds of are hit as from lists",
          "[traversal]")
{
    const Scene scene = quadrics_and_polygons(700);
    for (const std::string& isa : supported_isas()) {
        INFO(isa);
        const RenderOptions options{.isa = isa};
        // Rays from nearby and from 400 away alternate.
        compare_traversals(scene, many_rays<float>(3000, 5), options);
        compare_frames(frame_of<float>(scene, options, Traversal::list),
                       frame_of<float>(scene, options, Traversal::tree));
    }
}

TEST_CASE("a few objects very far from the rest are in no bvh", "[traversal]")
{
    Scene scene = random_spheres(300, 1);
    const auto packed = [&] { return PackedScene<float>(lower(scene), Traversal::tree); };
    const abi::BvhView<float> alone = packed().view().tree;
    const std::vector<Vec3> far{{0, 0, 9e8}, {1e6, 0, 0}, {0, -1e5, 0}};
    for (const Vec3& center : far)
        add_sphere(scene, center, 1.0, scratch(Rgb(0.5), 50, 0.3));
    const PackedScene<float> with_far = packed();
    CHECK(with_far.view().tree.extent == alone.extent);
    CHECK(with_far.view().spheres.count == 3);

    // This also holds for moved objects.
    RayScene<float> moving(scene);
    scene.objects[0].surface = Sphere{{0, 1e7, 0}, 1.0};
    const std::int32_t moved[] = {0};
    (void)moving.update(scene, moved);
    const RayColumns<float> rays = many_rays<float>(2000, 3);
    Results<float> results = trace(scene, rays, {}, Traversal::list);
    std::vector<float> t(rays.size());
    std::vector<std::int32_t> object(rays.size());
    moving.closest_hits(rays.view(), {t.data(), object.data()});
    CHECK(different_bits(t, results.t) == 0);
    CHECK(different_bits(object, results.object) == 0);
    const Ray<float> up{{0, 100, 0}, {0, 1, 0}};
    CHECK(moving.closest_hit(up).object == 0);

    // If half of the objects is far away, no objects count as far.
    Scene halves = random_spheres(300, 1);
    for (int i = 0; i < 150; ++i)
        halves.objects[static_cast<std::size_t>(i)].surface = Sphere{{0, 0, 1e6}, 1.0};
    CHECK(count_tree_objects(lower(halves)).all() == 300);
}

TEST_CASE("objects too far away for a bvh overwrite nothing and hide nothing", "[traversal]")
{
    for (const double far : {1e10, 9e11}) {
        for (const int apart : {1, 2, 40}) {
            Scene scene;
            const Material material = scratch(Rgb(0.5), 50, 0.3);
            for (int i = 0; i < 80; ++i) {
                const double x = i % apart == 0 ? (i % 4 < 2 ? far : -far) : i % 20 - 10;
                const Vec3 center(x, i / 20, 5 + i % 3);
                if (i % 2 == 0) {
                    add_sphere(scene, center, 0.5, material);
                } else {
                    add_object(scene, quadric_of(2), material);
                    scene.objects.back().transform =
                        glm::scale(glm::translate(Mat4(1.0), center), Vec3(0.5, 0.3, 0.4));
                }
            }
            add_plane(scene, {0, 6, 0}, {0.1, -1, 0}, material);
            for (const std::string& isa : supported_isas()) {
                INFO(isa << ", " << far << ", one in " << apart);
                const RenderOptions options{.isa = isa};
                compare_traversals(scene, many_rays<float>(500, 7), options);
                compare_traversals(scene, many_rays<double>(500, 7), options);
            }
        }
    }
}

TEST_CASE("unbounded caps are found through a bvh too", "[traversal]")
{
    // The caps close the outside of the ellipsoid.
    Quadric inside_out{.coefficients = {-1, -2, -3, 0, 0, 0, 0, 0, 0, 1},
                       .z_range = ZRange{-0.5, 0.2},
                       .capped = true};
    Scene scene;
    const Material material = scratch(Rgb(0.5), 50, 0.3);
    add_object(scene, inside_out, material);
    add_sphere(scene, {0, 0, 6}, 0.5, material);
    add_sphere(scene, {4, 0, 6}, 0.5, material);
    for (const std::string& isa : supported_isas()) {
        const RenderOptions options{.isa = isa};
        compare_traversals(scene, many_rays<float>(2000, 3), options);
        compare_traversals(scene, many_rays<double>(2000, 3), options);
    }
    const RayColumns<double> rays = many_rays<double>(2000, 3);
    const RenderOptions scalar{.kernel = Kernel::scalar};
    const Results<double> expected = trace(scene, rays, scalar, Traversal::automatic);
    const Results<double> packets = trace(scene, rays, {}, Traversal::tree);
    CHECK(packets.hits == expected.hits);
}

TEST_CASE("lists and bvhs give the same for a hundred scenes", "[traversal][slow]")
{
    compare_on_every_isa(100, 5000, 1000);
}

TEST_CASE("light through glass passes a bvh as it passes a list", "[traversal]")
{
    Scene scene = mixed_scene(60, 3);
    scene.illumination = Illumination::whitted;
    scene.shadows = ShadowKind::transparent;
    WhittedMaterial glass{.diffuse = Rgb(0.4), .transmissive = Rgb(0.5), .ior = 1.3};
    for (Object& object : scene.objects)
        object.material.model = glass;
    Image<double> pictures[2];
    for (int i = 0; i < 2; ++i) {
        const RenderOptions options{.traversal = i == 0 ? Traversal::list : Traversal::tree};
        Renderer<double>(scene, options).render(pictures[i]);
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < pictures[0].rgb.size(); ++i)
        worst = std::max(worst, std::abs(pictures[0].rgb[i] - pictures[1].rgb[i]));
    // Shares are multiplied in the order in which occluders are found.
    CHECK(worst < 1e-12);
    CHECK(pictures[0].rgb[3 * 70 * 25] >= 0.0);
}

}  // namespace packtrace::test
