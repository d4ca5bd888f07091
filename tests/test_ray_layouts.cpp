#include "catch.hpp"
#include "refusal.hpp"
#include "render/ray_columns.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"
#include <packtrace/build.hpp>
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>

#include <random>
#include <stop_token>
#include <vector>

// Rays in structs, in spans and alone get the answers of rays in arrays. Long queries report their
// progress and can be stopped.
namespace packtrace::test {
namespace {

template <class Real>
std::vector<Ray<Real>> scattered_rays(std::size_t count)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<Real> place(Real(-0.2), Real(1.2));
    std::vector<Ray<Real>> rays(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            rays[i].org[axis] = place(random);
            rays[i].dir[axis] = place(random) - Real(0.5);
        }
        if (i % 3 == 0)
            rays[i].t_min = Real(0.1);
        if (i % 5 == 0)
            rays[i].t_max = Real(0.7);
    }
    return rays;
}

template <class Real>
RayColumns<Real> columns_of(const std::vector<Ray<Real>>& rays)
{
    RayColumns<Real> columns;
    for (const Ray<Real>& ray : rays)
        columns.add({ray.org[0], ray.org[1], ray.org[2], ray.dir[0], ray.dir[1], ray.dir[2],
                     ray.t_min, ray.t_max});
    return columns;
}

template <class Real>
RaySpans<Real> spans_of(const RayColumns<Real>& rays)
{
    const auto& c = rays.columns;
    return {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]};
}

Scene ball_scene()
{
    return generate_random_spheres({.count = 400, .radius = 0.03});
}

template <class Real>
std::vector<SurfaceHit<Real>> closest_of_spans(const RayScene<Real>& scene,
                                               const std::vector<Ray<Real>>& rays)
{
    const RayColumns<Real> columns = columns_of(rays);
    std::vector<Real> t(rays.size()), nx(t), ny(t), nz(t);
    std::vector<std::int32_t> object(rays.size());
    const HitSpans<Real> hits{t, object, nx, ny, nz};
    scene.closest_hits(spans_of(columns).view(), hits.view(rays.size()));
    std::vector<SurfaceHit<Real>> found;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        found.push_back({t[i], object[i], {}});
        if (object[i] >= 0)
            found.back() = {t[i], object[i], {nx[i], ny[i], nz[i]}};
    }
    return found;
}

/// A caller's own struct that contains a ray and its hit.
template <class Real>
struct Photon {
    int id = 0;
    Ray<Real> ray;
    double power = 1.0;
    SurfaceHit<Real> hit;
};

template <class Real>
void check_structs(const RenderOptions& options)
{
    const RayScene<Real> scene(ball_scene(), options);
    const auto rays = scattered_rays<Real>(1000);
    const auto expected = closest_of_spans(scene, rays);
    std::vector<SurfaceHit<Real>> hits(rays.size());
    scene.closest_hits(rays, hits);
    std::vector<Photon<Real>> photons(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
        photons[i].ray = rays[i];
    scene.closest_hits(RayStructs<Real>(&photons[0].ray, photons.size(), sizeof photons[0]),
                       HitStructs<Real>(&photons[0].hit, photons.size(), sizeof photons[0]));
    std::size_t wrong = 0;
    std::size_t found = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        wrong += same_bits(hits[i], expected[i]) ? 0u : 1u;
        wrong += same_bits(photons[i].hit, expected[i]) ? 0u : 1u;
        wrong += same_bits(scene.closest_hit(rays[i]), expected[i]) ? 0u : 1u;
        found += expected[i].object >= 0 ? 1u : 0u;
    }
    CHECK(wrong == 0);
    CHECK(found > 100);
    CHECK(found < 800);
}

}  // namespace

TEST_CASE("rays in structs, with any stride, and alone hit what rays in arrays hit",
          "[ray_layouts]")
{
    const RenderOptions scalar{.kernel = Kernel::scalar};
    check_structs<float>({});
    check_structs<double>({});
    check_structs<double>(scalar);
}

TEST_CASE("all queries work for rays in structs and for one ray", "[ray_layouts]")
{
    const RayScene<double> scene(ball_scene());
    const auto rays = scattered_rays<double>(600);
    const RayColumns<double> columns = columns_of(rays);
    const RaysView<double> view = columns.view();

    std::vector<std::uint8_t> mask(rays.size()), expected_mask(rays.size());
    scene.occluded(view, expected_mask.data());
    scene.occluded(rays, mask);
    CHECK(mask == expected_mask);

    std::vector<std::vector<SurfaceHit<double>>> all;
    scene.all_hits(view,
                   [&](std::size_t, auto hits) { all.emplace_back(hits.begin(), hits.end()); });
    std::size_t next = 0;
    std::size_t wrong = 0;
    scene.all_hits(rays, [&](std::size_t ray, auto hits) {
        wrong += ray == next++ ? 0u : 1u;
        wrong += same_bits(hits, all[ray]) ? 0u : 1u;
    });
    CHECK(next == rays.size());

    std::vector<std::int32_t> object;
    for (const Ray<double>& ray : rays)
        object.push_back(scene.closest_hit(ray).object);
    std::vector<HitBounds> bounds(rays.size()), expected(rays.size());
    scene.bound_closest_hits(view, object.data(), expected.data());
    scene.bound_closest_hits(rays, object, bounds);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        wrong += scene.occluded(rays[i]) == (mask[i] != 0) ? 0u : 1u;
        const auto hits = scene.all_hits(rays[i]);
        wrong += same_bits(hits, all[i]) ? 0u : 1u;
        wrong += same_bits(bounds[i], expected[i]) ? 0u : 1u;
        wrong += same_bits(scene.bound_closest_hit(rays[i], object[i]), expected[i]) ? 0u : 1u;
        std::vector<HitBounds> of_all(hits.size());
        scene.bound_all_hits(view, i, hits, of_all);
        const auto alone = scene.bound_all_hits(rays[i], hits);
        wrong += same_bits(alone, of_all) ? 0u : 1u;
    }
    CHECK(wrong == 0);
}

TEST_CASE("arrays of another length than the rays are refused by name", "[ray_layouts]")
{
    const RayScene<float> scene(ball_scene());
    const auto rays = scattered_rays<float>(5);
    RayColumns<float> columns = columns_of(rays);
    std::vector<SurfaceHit<float>> hits(4);
    CHECK(refusal<std::invalid_argument>([&] { scene.closest_hits(rays, hits); }) ==
          "hits has 4 elements, where there are 5 rays; give it one for each ray");
    std::vector<std::uint8_t> mask(6);
    CHECK_THAT(refusal<std::invalid_argument>([&] { scene.occluded(rays, mask); }),
               ContainsSubstring("mask has 6"));
    columns.columns[4].pop_back();
    CHECK_THAT(refusal<std::invalid_argument>([&] { (void)spans_of(columns).view(); }),
               ContainsSubstring("dir_y has 4"));
    std::vector<float> t(5);
    std::vector<std::int32_t> object(5);
    const HitSpans<float> spans{t, object, std::span(t).first(3)};
    CHECK_THAT(refusal<std::invalid_argument>([&] { (void)spans.view(5); }),
               ContainsSubstring("normal_x has 3"));
}

TEST_CASE("missing arrays are refused by name, unless there are no rays", "[ray_layouts]")
{
    const RayScene<float> scene(ball_scene());
    const RayColumns<float> columns = columns_of(scattered_rays<float>(3));
    const RaysView<float> rays = spans_of(columns).view();
    std::vector<float> t(3);
    std::vector<std::int32_t> object(3);
    std::vector<float> place(3);
    std::vector<std::uint8_t> mask(3);
    HitsView<float> hits{.t = t.data(), .object = object.data()};
    const auto refused = [](const auto& ask) { return refusal<std::invalid_argument>(ask); };

    for (const float* RaysView<float>::*array :
         {&RaysView<float>::org_x, &RaysView<float>::org_y, &RaysView<float>::org_z,
          &RaysView<float>::dir_x, &RaysView<float>::dir_y, &RaysView<float>::dir_z,
          &RaysView<float>::t_min, &RaysView<float>::t_max}) {
        RaysView<float> some = rays;
        some.*array = nullptr;
        CHECK_THAT(refused([&] { scene.closest_hits(some, hits); }), ContainsSubstring("is null"));
        CHECK_THAT(refused([&] { scene.occluded(some, mask.data()); }),
                   ContainsSubstring("is null"));
        CHECK_THAT(refused([&] { scene.all_hits(some, [](std::size_t, auto) {}); }),
                   ContainsSubstring("is null"));
    }
    CHECK(refused([&] { scene.occluded(rays, static_cast<std::uint8_t*>(nullptr)); }) ==
          "mask is null; give an array of 3");
    CHECK(refused([&] { scene.all_hits(rays, RayScene<float>::TakeHits()); }) ==
          "`take` is empty; give a function for the hits of a ray");
    const RayStructs<float> none(nullptr, 3);
    CHECK(refused([&] { scene.all_hits(none, RayScene<float>::TakeHits()); }) ==
          "`take` is empty; give a function for the hits of a ray");
    CHECK(refused([&] { scene.all_hits(none, [](std::size_t, auto) {}); }) ==
          "rays is null; give an array of 3");
    CHECK(refused([&] { scene.occluded(none, mask); }) == "rays is null; give an array of 3");
    const std::vector<Ray<float>> structs(3);
    CHECK(refused([&] { scene.closest_hits(structs, HitStructs<float>(nullptr, 3)); }) ==
          "hits is null; give an array of 3");
    CHECK(refused([&] { scene.bound_closest_hits(rays, nullptr, nullptr); }) ==
          "object is null; give an array of 3");
    CHECK(refused([&] { scene.lit(PointsView<float>{.count = 2}, 1, mask.data()); }) ==
          "point is null; give an array of 2");
    CHECK(refused([&] {
              scene.closest_hits(
                  rays, StartsView<float>{{place.data(), place.data(), place.data()}}, hits);
          }) == "surface of starts is null; give an array of 3");
    hits.object = nullptr;
    CHECK(refused([&] { scene.closest_hits(rays, hits); }) ==
          "object of hits is null; give an array of 3");
    hits.object = object.data();
    hits.point[0] = place.data();
    CHECK(refused([&] { scene.closest_hits(rays, hits); }) ==
          "point has arrays for some of x, y and z; give all or none");
    hits.point[1] = hits.point[2] = place.data();
    CHECK(refused([&] { scene.closest_hits(rays, hits); }) ==
          "point comes with normals alone; give arrays for them, too");

    scene.closest_hits(RaysView<float>{}, HitsView<float>{});
    scene.occluded(RaysView<float>{}, static_cast<std::uint8_t*>(nullptr));
    scene.lit(PointsView<float>{}, 1, nullptr);
}

TEST_CASE("a query reports its progress, and stops when asked to", "[ray_layouts]")
{
    const RayScene<float> scene(ball_scene());
    const auto rays = scattered_rays<float>(50'000);
    std::vector<SurfaceHit<float>> hits(rays.size()), expected(rays.size());
    scene.closest_hits(rays, expected);

    std::vector<double> shares;
    QueryWatch watch;
    watch.progress = [&](double share) { shares.push_back(share); };
    scene.closest_hits(rays, hits, watch);
    CHECK(same_bits(hits, expected));
    CHECK(shares.size() > 5);
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.back() == 1.0);

    const RayColumns<float> columns = columns_of(rays);
    std::vector<std::uint8_t> mask(rays.size());
    std::vector<HitBounds> bounds(rays.size());
    const std::vector<std::int32_t> none(rays.size(), -1);
    const RaysView<float> view = columns.view();
    const std::vector<std::function<void(const QueryWatch&)>> queries = {
        [&](const QueryWatch& w) { scene.closest_hits(rays, hits, w); },
        [&](const QueryWatch& w) { scene.occluded(view, mask.data(), w); },
        [&](const QueryWatch& w) {
            scene.all_hits(
                view, [](std::size_t, auto) {}, w);
        },
        [&](const QueryWatch& w) { scene.bound_closest_hits(rays, none, bounds, w); }};
    for (const auto& query : queries) {
        std::stop_source source;
        QueryWatch stopping{.stop = source.get_token()};
        double reached = 0.0;
        stopping.progress = [&](double share) {
            reached = share;
            if (share > 0.3)
                source.request_stop();
        };
        CHECK_THROWS_AS(query(stopping), StopError);
        CHECK(reached > 0.3);
        CHECK(reached < 0.6);
    }
}

TEST_CASE("rays are numbered consecutively in a query of all hits with progress", "[ray_layouts]")
{
    const RayScene<float> scene(ball_scene());
    const auto rays = scattered_rays<float>(9'000);
    QueryWatch watch;
    watch.progress = [](double) {};
    std::size_t next = 0;
    std::size_t wrong = 0;
    scene.all_hits(
        rays, [&](std::size_t ray, auto) { wrong += ray == next++ ? 0u : 1u; }, watch);
    CHECK(next == rays.size());
    CHECK(wrong == 0);
}

}  // namespace packtrace::test
