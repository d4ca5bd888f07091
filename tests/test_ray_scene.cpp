#include "catch.hpp"
#include "packet_ways.hpp"
#include "page_end.hpp"
#include "reference_scenes.hpp"
#include "refusal.hpp"
#include "render/ray_columns.hpp"
#include "render/ray_pieces.hpp"
#include "render_scene.hpp"
#include <packtrace/explain.hpp>
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <random>
#include <vector>

// A caller's own rays: packets against the scalar reference, in double precision.
namespace packtrace::test {
namespace {

RayColumns<double> random_rays(int count)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-4.0, 4.0);
    RayColumns<double> rays;
    for (int i = 0; i < count; ++i) {
        for (std::size_t column = 0; column < 6; ++column)
            rays.columns[column].push_back(place(random));
        rays.columns[6].push_back(i % 3 == 0 ? 0.5 : 0.0);
        rays.columns[7].push_back(i % 5 == 0 ? 1.5 : std::numeric_limits<double>::infinity());
    }
    return rays;
}

Scene mixed_scene()
{
    Scene scene{.objects = {sphere({0, 0, 0}, 1.5), plane({0, -2, 0}, {0.2, 1, 0.1}),
                            sphere({0, -5002, 0}, 5000), sphere({2, 1, -1}, 0.7)}};
    for (int i = 0; i < 4; ++i) {
        Quadric surface{.coefficients = {1, i == 2 ? -1.0 : 1.0, i == 1 ? -1.0 : 0.0, 0, 0, 0, 0, 0,
                                         i == 2 ? -1.0 : 0.0, i == 3 ? -0.5 : -1.0},
                        .z_range = ZRange{-1.0, 0.8},
                        .capped = i != 2};
        scene.objects.push_back(
            {.surface = surface,
             .transform = glm::rotate(glm::translate(Mat4(1.0), {i - 1.0, 0.5 * i, 1.0 - i}),
                                      0.7 * i, Vec3(1, 2, 3))});
    }
    return scene;
}

RenderOptions on(const std::string& isa)
{
    return {.isa = isa};
}

RenderOptions scalar()
{
    return {.kernel = Kernel::scalar};
}

template <class Real>
struct RayAnswers {
    HitColumns<Real> hits;
    std::vector<std::uint8_t> mask;

    bool operator==(const RayAnswers&) const = default;
};

/// The hits of rays that are queried this many at a time.
template <class Real>
RayAnswers<Real> answers(const RayScene<Real>& scene, const RayColumns<Real>& rays,
                         std::size_t at_a_time)
{
    const std::size_t count = rays.size();
    RayAnswers<Real> result{HitColumns<Real>(count), std::vector<std::uint8_t>(count)};
    for (std::size_t first = 0; first < count; first += at_a_time) {
        const RaysView<Real> view = rays.view(first, std::min(at_a_time, count - first));
        scene.closest_hits(view, part_of(result.hits.view(), first));
        scene.occluded(view, &result.mask[first]);
    }
    return result;
}

RayAnswers<double> closest(const RenderOptions& options, const RayColumns<double>& rays)
{
    return answers(RayScene<double>(mixed_scene(), options), rays, rays.size());
}

using AllHits = std::vector<std::vector<SurfaceHit<double>>>;

AllHits all_hits(const RenderOptions& options, const RayColumns<double>& rays)
{
    const RayScene<double> scene(mixed_scene(), options);
    AllHits result;
    scene.all_hits(rays.view(), [&](std::size_t ray, auto hits) {
        REQUIRE(ray == result.size());
        result.emplace_back(hits.begin(), hits.end());
    });
    return result;
}

}  // namespace

TEST_CASE("packets find the closest hits of any rays, with outward normals", "[ray_scene]")
{
    for (const int count : {1, 3, 16, 1237}) {
        const RayColumns<double> rays = random_rays(count);
        const auto [truth, truth_mask] = closest(scalar(), rays);
        for (const std::string& isa : supported_isas()) {
            CAPTURE(isa, count);
            const auto [found, mask] = closest(on(isa), rays);
            CHECK(found.object == truth.object);
            CHECK(mask == truth_mask);
            for (std::size_t i = 0; i < found.t.size(); ++i) {
                if (truth.object[i] < 0) {
                    CHECK(found.t[i] == rays.columns[7][i]);
                    continue;
                }
                // On a ground of radius 5000 packets lose the last digits of a hit point.
                CHECK(std::abs(found.t[i] - truth.t[i]) <= 1e-10 * truth.t[i] + 1e-12);
                for (std::size_t axis = 0; axis < 3; ++axis)
                    CHECK(std::abs(found.normal[axis][i] - truth.normal[axis][i]) < 1e-9);
            }
        }
    }
}

TEST_CASE("packets list all hits of a ray in order", "[ray_scene]")
{
    const RayColumns<double> rays = random_rays(700);
    const AllHits truth = all_hits(scalar(), rays);
    std::size_t most = 0;
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        const AllHits found = all_hits(on(isa), rays);
        REQUIRE(found.size() == truth.size());
        for (std::size_t ray = 0; ray < found.size(); ++ray) {
            CAPTURE(ray);
            most = std::max(most, truth[ray].size());
            REQUIRE(found[ray].size() == truth[ray].size());
            for (std::size_t i = 0; i < found[ray].size(); ++i) {
                CHECK(found[ray][i].object == truth[ray][i].object);
                CHECK(std::abs(found[ray][i].t - truth[ray][i].t) <= 1e-9 * truth[ray][i].t);
                for (int axis = 0; axis < 3; ++axis)
                    CHECK(std::abs(found[ray][i].normal[axis] - truth[ray][i].normal[axis]) < 1e-8);
            }
        }
    }
    CHECK(most >= 6);
}

namespace {

/// Rays from one origin; with `both_zeros`, its first coordinate is 0 with either sign.
template <class Real>
RayColumns<Real> rays_from_one_place(int count, bool both_zeros)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> way(-1.0, 1.0);
    RayColumns<Real> rays;
    for (int i = 0; i < count; ++i) {
        const Vec3 org(both_zeros && i % 7 == 6 ? -0.0 : 0.0, 0.3, -3.1);
        Vec3 dir;
        for (int axis = 0; axis < 3; ++axis)
            dir[axis] = way(random);
        rays.add(org, dir, i % 3 == 0 ? 0.5 : 0.0,
                 i % 5 == 0 ? 2.5 : std::numeric_limits<double>::infinity());
    }
    return rays;
}

template <class Real>
void check_together_as_alone(const RenderOptions& options)
{
    const RayScene<Real> scene(mixed_scene(), options);
    for (const bool both_zeros : {false, true}) {
        const RayColumns<Real> rays = rays_from_one_place<Real>(1237, both_zeros);
        const RayAnswers<Real> alone = answers(scene, rays, 1);
        CAPTURE(options.isa, both_zeros);
        CHECK(std::count(alone.hits.object.begin(), alone.hits.object.end(), -1) > 100);
        CHECK(std::count(alone.mask.begin(), alone.mask.end(), 1) > 100);
        // 64 and more rays with one origin share precomputed values.
        for (const std::size_t at_a_time : {64U, 77U, 300U, 1237U})
            CHECK((answers(scene, rays, at_a_time) == alone));
    }
}

}  // namespace

TEST_CASE("rays from one origin have the same bits together as alone", "[ray_scene]")
{
    for (const std::string& isa : supported_isas()) {
        RenderOptions options = on(isa);
        check_together_as_alone<double>(options);
        for (const Accuracy accuracy : {Accuracy::fast, Accuracy::exact}) {
            options.accuracy = accuracy;
            check_together_as_alone<float>(options);
        }
    }
}

TEST_CASE("a ray from just above a sphere hits it at once, not on its way out", "[ray_scene]")
{
    // In single precision the start is inside: the roots are -8e-7 and 0.33.
    Scene scene{.objects = {sphere({-2.0317530632019043, 3.1829373836517334, -1.6853139400482178},
                                   1.5742509365081787)}};
    RayColumns<float> ray;
    ray.add({-1.3746360540390015f, 3.3577628135681152f, -0.26549023389816284f},
            {0.52764761447906494f, 0.72186774015426636f, -0.44776657223701477f});
    for (const std::string& isa : supported_isas()) {
        INFO(isa);
        const RayScene<float> rays(scene, {.isa = isa});
        float t = 0;
        std::int32_t object = -1;
        rays.closest_hits(ray.view(), {&t, &object});
        CHECK(object == 0);
        CHECK(t == Approx(1.2321839e-7f));
    }
}

namespace {

/// Segments from a point to points on spheres of a scene. Some end before their target and some
/// behind it, by as little as single precision can represent.
template <class Real>
RayColumns<Real> segments_to_surfaces(const Scene& scene, int count)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    const Vec3 from(4, 6, -4);
    RayColumns<Real> segments;
    for (int i = 0; i < count; ++i) {
        const Object& object = scene.objects[static_cast<std::size_t>(i) % scene.objects.size()];
        const auto& ball = std::get<Sphere>(object.surface);
        const Vec3 out = glm::normalize(Vec3(value(random), value(random), value(random)));
        const Vec3 way = ball.center + ball.radius * out - from;
        const double beyond = i % 7 == 0 ? 0.0 : value(random) * std::pow(10.0, -4 - i % 4);
        segments.add(from, Vec3(glm::vec3(way)), 0.0, static_cast<float>(1.0 + beyond));
    }
    return segments;
}

template <class Real>
std::vector<std::uint8_t> blocked_segments(const Scene& scene, const RenderOptions& options)
{
    const RayColumns<Real> segments = segments_to_surfaces<Real>(scene, 6000);
    std::vector<std::uint8_t> blocked(segments.size());
    RayScene<Real>(scene, options).occluded(segments.view(), blocked.data());
    return blocked;
}

}  // namespace

TEST_CASE("segments that end at surfaces are occluded as in double precision", "[ray_scene]")
{
    const Scene scene = generate_random_spheres({.count = 1500, .radius = 0.05});
    for (const std::string& isa : supported_isas()) {
        for (const Traversal traversal : {Traversal::list, Traversal::tree}) {
            CAPTURE(isa, static_cast<int>(traversal));
            const RenderOptions options{.isa = isa, .traversal = traversal};
            const std::vector<std::uint8_t> expected = blocked_segments<double>(scene, options);
            CHECK(std::count(expected.begin(), expected.end(), std::uint8_t{0}) > 100);
            CHECK(blocked_segments<float>(scene, options) == expected);
        }
    }
}

TEMPLATE_TEST_CASE("invalid numbers of objects and surfaces are refused", "[ray_scene]", float,
                   double)
{
    const RayScene<TestType> scene(parse_scene(R"(
        light { type = point  intensity = 1  position = (0, 9, 0) }
        sphere { center = (0, 0, 5)  radius = 1 }
    )",
                                               "one", {}));
    const Ray<TestType> ray{{0, 0, 0}, {0, 0, 1}};
    for (const std::int32_t object : {-2, 1, std::numeric_limits<std::int32_t>::max()}) {
        CHECK_THROWS_AS(scene.bound_closest_hit(ray, object), std::invalid_argument);
        const SurfaceHit<TestType> hit{4, object, {}};
        CHECK_THROWS_AS(scene.bound_all_hits(ray, std::span(&hit, 1)), std::invalid_argument);
    }
    const TestType zero[] = {0, 0};
    const TestType one[] = {1, 1};
    const TestType nine[] = {9, 9};
    const RaysView<TestType> rays{zero, zero, zero, zero, zero, one, zero, nine, 2};
    TestType t[2];
    std::int32_t found[2];
    const HitsView<TestType> hits{t, found};
    std::uint8_t mask[2];
    const auto leave = [&](std::int32_t surface) {
        const std::int32_t surfaces[] = {0, surface};
        scene.closest_hits(rays, {{zero, zero, nine}, surfaces}, hits);
        scene.lit({{zero, zero, nine}, surfaces, 2}, 0, mask);
    };
    for (const std::int32_t surface : {1, -3, 1'000'000})
        CHECK_THROWS_WITH(leave(surface), ContainsSubstring("surface " + std::to_string(surface)));
    for (const std::int32_t surface : {0, -1, no_start})
        CHECK_NOTHROW(leave(surface));
    // A point that is not on the object.
    const std::int32_t none[] = {-1, -7};
    CHECK_NOTHROW(scene.lit({{zero, zero, nine}, none, 2}, 0, mask));
}

TEST_CASE("a ray with a NaN hits nothing", "[ray_scene]")
{
    RayColumns<double> rays = random_rays(8);
    for (std::size_t column = 0; column < 8; ++column)
        rays.columns[column][column] = std::numeric_limits<double>::quiet_NaN();
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            CHECK(closest(on(isa.name), rays).hits.object == std::vector<std::int32_t>(8, -1));
}

TEMPLATE_TEST_CASE("a ray that ends at a NaN hits nothing in any query", "[ray_scene]", float,
                   double)
{
    const Scene scene = parse_scene("sphere { center = (0, 0, 5)  radius = 1 }", "one", {});
    Ray<TestType> ray{{0, 0, 0}, {0, 0, 1}};
    ray.t_max = std::numeric_limits<TestType>::quiet_NaN();
    for (const RenderOptions& options : packet_ways()) {
        const RayScene<TestType> rays(scene, options);
        CHECK_FALSE(rays.occluded(ray));
        CHECK(rays.closest_hit(ray).object == -1);
        CHECK(rays.all_hits(ray).empty());
    }
}

TEMPLATE_TEST_CASE("no value after those of the last ray is read or written", "[ray_scene]", float,
                   double)
{
    using Real = TestType;
    const RayColumns<double> some = random_rays(67);
    Scene lit = mixed_scene();
    lit.lights.push_back(point_light({0, 9, 0}, 1.0));
    for (const RenderOptions& options : packet_ways()) {
        const RayScene<Real> scene(lit, options);
        for (const std::size_t count : {std::size_t{1}, std::size_t{6}, some.size()}) {
            RayColumns<Real> rays;
            // A deque does not move its elements.
            std::deque<PageEnd<Real>> column;
            for (std::size_t i = 0; i < rays.columns.size(); ++i) {
                rays.columns[i].assign(
                    some.columns[i].begin(),
                    some.columns[i].begin() + static_cast<std::ptrdiff_t>(count));
                column.emplace_back(std::span<const Real>(rays.columns[i]));
            }
            const auto at = [&](std::size_t i) { return column[i].data(); };
            const RaysView<Real> view{at(0), at(1), at(2), at(3), at(4),
                                      at(5), at(6), at(7), count};
            for (int i = 0; i < 14; ++i)
                column.emplace_back(count);
            const PageEnd<std::int32_t> object(count), surface(count), next(count);
            const PageEnd<std::uint8_t> mask(count);
            const HitsView<Real> hits{at(8),
                                      object.data(),
                                      at(9),
                                      at(10),
                                      at(11),
                                      {at(12), at(13), at(14)},
                                      {at(15), at(16), at(17)},
                                      {at(18), at(19), at(20)},
                                      surface.data()};
            scene.closest_hits(view, hits);
            HitColumns<Real> same(count);
            scene.closest_hits(rays.view(), same.view());
            CHECK(object.values() == same.object);
            CHECK(column[8].values() == same.t);
            scene.occluded(view, mask.data());
            scene.lit({{at(18), at(19), at(20)}, surface.data(), count}, 0, mask.data());
            // Queries of t alone, and of rays that leave the hits.
            scene.closest_hits(view, {at(21), next.data()});
            CHECK(next.values() == same.object);
            RaysView<Real> leaving = view;
            leaving.org_x = at(12);
            leaving.org_y = at(13);
            leaving.org_z = at(14);
            scene.closest_hits(leaving, {{at(18), at(19), at(20)}, surface.data()},
                               {at(21), next.data()});
        }
    }
}

TEST_CASE("a ray whose start is too far away for finite squares misses", "[ray_scene]")
{
    const Scene scene = parse_scene("sphere { center = (0, 0, -9)  radius = 1 }", "one", {});
    const float zero = 0;
    const float far = 2e19f;
    const float end = 1e30f;
    const std::int32_t surface = 0;
    const RaysView<float> ray{&zero, &zero, &far, &zero, &far, &zero, &zero, &end, 1};
    for (const RenderOptions& options : packet_ways()) {
        float t = 0;
        std::int32_t object = 0;
        RayScene<float>(scene, options)
            .closest_hits(ray, {{&zero, &zero, &far}, &surface}, {&t, &object});
        CHECK(object == -1);
    }
}

TEMPLATE_TEST_CASE("a miss has no point, and no surface to start on", "[ray_scene]", float, double)
{
    const Scene scene = parse_scene(
        "light { type = point  intensity = 1  position = (0, 9, 0) }\n"
        "sphere { center = (0, 0, 5)  radius = 1 }\n"
        "sphere { center = (3, 0, 5)  radius = 1 }\n",
        "two", {});
    // Packets with hits on one surface and misses, with hits on two surfaces, and with misses
    // alone.
    for (const TestType step : {TestType(0.05), TestType(0.2), TestType(-4)}) {
        constexpr std::size_t count = 32;
        std::vector<TestType> x(count), zero(count), one(count, 1), far(count, 1000);
        for (std::size_t i = 0; i < count; ++i)
            x[i] = step < 0 ? step : step * static_cast<TestType>(i) - TestType(0.5);
        const RaysView<TestType> view{x.data(),    zero.data(), zero.data(),
                                      zero.data(), zero.data(), one.data(),
                                      zero.data(), far.data(),  count};
        for (const RenderOptions& options : packet_ways()) {
            const RayScene<TestType> rays(scene, options);
            std::vector<TestType> t(count), values[12];
            std::vector<std::int32_t> object(count), surface(count);
            TestType* at[12];
            for (int i = 0; i < 12; ++i) {
                values[i].resize(count);
                at[i] = values[i].data();
            }
            rays.closest_hits(view, {t.data(),
                                     object.data(),
                                     at[0],
                                     at[1],
                                     at[2],
                                     {at[3], at[4], at[5]},
                                     {at[6], at[7], at[8]},
                                     {at[9], at[10], at[11]},
                                     surface.data()});
            std::vector<std::uint8_t> lit(count);
            rays.lit({{at[9], at[10], at[11]}, surface.data(), count}, 0, lit.data());
            int misses = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const bool missed = object[i] < 0;
                misses += missed ? 1 : 0;
                CHECK((surface[i] == no_start) == missed);
                for (int place = 3; place < 12; ++place)
                    CHECK(std::isnan(values[place][i]) == missed);
                for (int axis = 0; axis < 3; ++axis)
                    CHECK((values[axis][i] == 0) >= missed);
                CHECK((missed ? lit[i] == 0 : lit[i] <= 1));
            }
            CHECK(misses > 0);
        }
    }
}

TEST_CASE("a vector of hits needs all of its arrays or none", "[ray_scene]")
{
    const RayScene<float> scene(
        parse_scene("sphere { center = (0, 0, 5)  radius = 1 }", "one", {}));
    const float zero = 0;
    const float one = 1;
    const RaysView<float> ray{&zero, &zero, &zero, &zero, &zero, &one, &zero, &one, 1};
    float t = 0;
    float normal = 0;
    std::int32_t object = 0;
    CHECK_THROWS_WITH(scene.closest_hits(ray, {&t, &object, &normal}), ContainsSubstring("normal"));
    const SurfaceHit<float> hit{4, 0, {}};
    HitBounds bounds;
    CHECK_THROWS_WITH(scene.bound_all_hits(ray, 1, {&hit, 1}, {&bounds, 1}),
                      ContainsSubstring("ray 1 of 1"));
    CHECK_THROWS_AS(scene.bound_all_hits({.count = 1}, 0, {&hit, 1}, {&bounds, 1}),
                    std::invalid_argument);
}

namespace {

struct Refused {
    const char* why;
    Object object;
    const char* what;
};

Object quadric_with(const std::function<void(Quadric&)>& change)
{
    Quadric surface{.coefficients = {1, 1, 1, 0, 0, 0, 0, 0, 0, -1}};
    change(surface);
    return {.surface = surface};
}

/// A quadric as a user may write it who expects the kind to be enough.
Quadric quadric_kind_alone(QuadricKind kind)
{
    return {.kind = kind};
}

Object moved(const Mat4& transform)
{
    Object object = sphere({0, 0, 0}, 1);
    object.transform = transform;
    return object;
}

std::vector<Refused> refused_objects()
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double inf = std::numeric_limits<double>::infinity();
    Object of_another_model = sphere({0, 0, 0}, 1);
    of_another_model.material.model = WhittedMaterial{};
    return {
        {"radius -1", sphere({0, 0, 0}, -1), "radius"},
        {"radius 0", sphere({0, 0, 0}, 0), "radius"},
        {"radius NaN", sphere({0, 0, 0}, nan), "radius"},
        {"radius infinite", sphere({0, 0, 0}, inf), "radius"},
        {"center NaN", sphere({0, nan, 0}, 1), "center"},
        {"no normal", plane({0, 0, 0}, {0, 0, 0}), "normal"},
        {"point infinite", plane({0, inf, 0}, {0, 1, 0}), "point"},
        {"a kind alone",
         quadric_with([](Quadric& q) { q = quadric_kind_alone(QuadricKind::ellipsoid); }),
         "quadric's kind"},
        {"another kind", quadric_with([](Quadric& q) { q.kind = QuadricKind::cone; }),
         "quadric's kind"},
        {"coefficient NaN", quadric_with([](Quadric& q) { q.coefficients[3] = nan; }),
         "coefficient"},
        {"no point", quadric_with([](Quadric& q) { q.coefficients[9] = 1; }), "no surface"},
        {"one point", quadric_with([](Quadric& q) { q.coefficients[9] = 0; }), "no surface"},
        {"nothing at all", quadric_with([](Quadric& q) { q.coefficients = {}; }), "no surface"},
        {"range upside down", quadric_with([](Quadric& q) {
             q.z_range = ZRange{1, -1};
         }),
         "z_range"},
        {"capped at no end", quadric_with([](Quadric& q) { q.capped = true; }), "capped"},
        {"flat", moved(glm::scale(Mat4(1.0), Vec3(1, 0, 1))), "flattens"},
        {"moved to NaN", moved(glm::translate(Mat4(1.0), Vec3(nan, 0, 0))), "matrix"},
        {"another model", of_another_model, "illumination"},
    };
}

/// The message with which every kernel, precision and entry point refuses the scene.
std::string common_message(const Scene& scene)
{
    std::string message;
    for (const Kernel kernel : {Kernel::scalar, Kernel::packet}) {
        const RenderOptions options{.kernel = kernel};
        for (const auto& call : std::vector<std::function<void()>>{
                 [&] { (void)render<float>(scene, options); },
                 [&] { (void)render<double>(scene, options); },
                 [&] { (void)RayScene<float>(scene, options); },
                 [&] { (void)RayScene<double>(scene, options); },
                 [&] { (void)explain_pixel<double>(scene, 0, 0, options); }}) {
            const std::string own = refusal(call);
            if (message.empty())
                message = own;
            CHECK(own == message);
        }
    }
    return message;
}

}  // namespace

TEST_CASE("every kernel refuses the same objects with the same words", "[ray_scene]")
{
    for (const Refused& refused : refused_objects()) {
        INFO(refused.why);
        Scene scene;
        scene.width = scene.height = 4;
        scene.objects = {sphere({0, 0, 3}, 1), refused.object};
        scene.objects[1].name = "odd one";
        const std::string message = common_message(scene);
        CHECK(message.find(" 'odd one': ") != std::string::npos);
        CHECK(message.find(refused.what) != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
        scene.objects[1].name.clear();
        const std::string kind = message.substr(0, message.find(' '));
        CHECK(common_message(scene).starts_with(kind + (kind == "sphere" ? " 2: " : " 1: ")));
    }
}

TEST_CASE("every kernel refuses a light without a direction", "[ray_scene]")
{
    for (const Vec3 vector : {Vec3(0.0), Vec3(0, std::nan(""), 1)}) {
        Scene scene;
        scene.width = scene.height = 4;
        scene.objects = {sphere({0, 0, 3}, 1)};
        scene.lights = {ambient(1), directional(vector, 1)};
        CHECK(common_message(scene).starts_with("light 2: "));
    }
}

}  // namespace packtrace::test
