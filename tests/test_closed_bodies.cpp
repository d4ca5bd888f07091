// Capped bodies are closed for packets too: rays from inside leave once more than they enter, lines
// from outside leave as often as they enter, at rims as well.
#include "catch.hpp"
#include "lab/stress/stress.hpp"
#include "reference_scenes.hpp"
#include "render/option_words.hpp"
#include "render/ray_columns.hpp"
#include "render_scene.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

namespace packtrace::test {
namespace {

/// The total number of hits of a ray without end.
template <class Real>
std::size_t count_hits(const Scene& scene, const RenderOptions& options, const Vec3& org,
                       const Vec3& dir)
{
    RayColumns<Real> rays;
    rays.add(org, dir);
    std::size_t count = 0;
    RayScene<Real>(scene, options)
        .all_hits(rays.view(), [&](std::size_t, std::span<const SurfaceHit<Real>> hits) {
            count = hits.size();
        });
    return count;
}

Object capped_cylinder()
{
    Object object = quadric({1, 1, 0, 0, 0, 0, 0, 0, 0, -1});
    auto& surface = std::get<Quadric>(object.surface);
    surface.z_range = ZRange{-1.0, 1.0};
    surface.capped = true;
    return object;
}

/// Tests every capped kind from inside and from outside; half of the rays are aimed at rims.
void check_closed(int rays, std::uint64_t seed)
{
    const lab::StressOptions options{.families = {"closed-bodies", "rims-outside"},
                                     .kernels = {"packet", "scalar"},
                                     .modes = {"exact"},
                                     .rays = rays,
                                     .seed = seed,
                                     .second_hits = false,
                                     .bounds = false};
    lab::run_stress(options, [](const std::vector<lab::StressRow>& rows) {
        for (const lab::StressRow& row : rows) {
            CAPTURE(row.family, language::word_of(row.precision), row.kernel, row.isa, row.example);
            if (row.kernel == "packet" || row.precision == Precision::double_) {
                CHECK(row.not_closed == 0);
                CHECK(row.lost == 0);
            }
        }
    });
}

}  // namespace

TEST_CASE("rays leave capped bodies as often as they enter them", "[closed_bodies]")
{
    check_closed(4000, 1);
}

TEST_CASE("many more rays leave capped bodies as often as they enter them", "[closed_bodies][slow]")
{
    check_closed(80000, 21);
}

/// A body between two caps, a x² + b y² + c z² + linear z + d <= 0, moved by an affine map.
Object capped_body(const glm::dvec4& squares_and_constant, double linear, const ZRange& range,
                   std::mt19937_64& random)
{
    const glm::dvec4& s = squares_and_constant;
    Object object = quadric({s.x, s.y, s.z, 0, 0, 0, 0, 0, linear, s.w});
    auto& surface = std::get<Quadric>(object.surface);
    surface.z_range = range;
    surface.capped = true;
    std::uniform_real_distribution<double> number(-1, 1);
    const glm::dvec3 axis(number(random), number(random), number(random));
    object.transform = glm::translate(glm::dmat4(1), 3.0 * axis) *
                       glm::rotate(glm::dmat4(1), 3 * number(random), axis) *
                       glm::scale(glm::dmat4(1), glm::dvec3(1.7, 0.6, 1.2));
    return object;
}

/// Every capped kind: cylinder, band of an ellipsoid, truncated cone, paraboloid, hyperboloids of
/// one sheet and of two.
std::vector<Object> capped_bodies(std::mt19937_64& random)
{
    return {capped_body({1, 1, 0, -1}, 0, {-1, 1}, random),
            capped_body({1, 1, 1, -1}, 0, {-0.3, 0.8}, random),
            capped_body({1, 1, -1, 0}, 0, {0.2, 1.5}, random),
            capped_body({1, 1, 0, 0}, -1, {0.1, 1}, random),
            capped_body({1, 1, -1, -0.25}, 0, {-1, 1}, random),
            capped_body({1, 1, -1, 0.25}, 0, {-1.5, 1}, random)};
}

/// The radius at height z of the side of such a body, by its definition.
double rim_radius(const Quadric& quadric, double z)
{
    const auto& k = quadric.coefficients;
    return std::sqrt(std::max(0.0, -(k[2] * z * z + k[8] * z + k[9]) / k[0]));
}

/// A point near a rim: in equal shares a little inside, a little outside, or exactly on the rim.
glm::dvec3 near_rim(const Quadric& quadric, std::mt19937_64& random)
{
    std::uniform_real_distribution<double> unit(0, 1);
    const double z = unit(random) < 0.5 ? quadric.z_range->low : quadric.z_range->high;
    const double turn = 6.2831853 * unit(random);
    const double off = (unit(random) - 0.5) * std::pow(10.0, -16 * unit(random));
    const double r = rim_radius(quadric, z) * (1 + off);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

/// Rays through points near the rims of one body.
template <class Real>
RayColumns<Real> rays_at_rims(const Object& body, int count, std::mt19937_64& random)
{
    std::uniform_real_distribution<double> number(-1, 1);
    RayColumns<Real> rays;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place(body.transform *
                               glm::dvec4(near_rim(std::get<Quadric>(body.surface), random), 1));
        const glm::dvec3 dir =
            glm::normalize(glm::dvec3(number(random), number(random), number(random)));
        rays.add(place - (8 + 5 * std::abs(number(random))) * dir, dir);
    }
    return rays;
}

/// Follows rays straight on through a body, each from the surface it starts on. Returns the number
/// of rays that enter the body and do not leave it, or leave it without having entered.
template <class Real>
int count_open_paths(const RayScene<Real>& scene, RayColumns<Real> rays)
{
    const std::size_t count = rays.size();
    auto& c = rays.columns;
    LeftHitColumns<Real> hits(count);
    scene.closest_hits(rays.view(), hits.view());
    std::vector<bool> inside(count, false);
    int open = 0;
    for (int generation = 0; generation < 6; ++generation) {
        for (std::size_t i = 0; i < count; ++i) {
            if (hits.object[i] < 0) {
                open += inside[i];
                inside[i] = false;
                hits.surface[i] = no_start;
                c[0][i] = std::numeric_limits<Real>::quiet_NaN();  // hits nothing from now on
                continue;
            }
            const Real slope = c[3][i] * hits.normal[0][i] + c[4][i] * hits.normal[1][i] +
                               c[5][i] * hits.normal[2][i];
            const bool goes_in = slope < 0;
            // At a tangent hit n·d may have either sign: both hits are at one point.
            open += goes_in == inside[i] && std::abs(slope) > Real(1e-3);
            inside[i] = !inside[i];
            for (std::size_t axis = 0; axis < 3; ++axis)
                c[axis][i] = (inside[i] ? hits.inner_start : hits.outer_start)[axis][i];
            if (inside[i])
                hits.surface[i] = ~hits.surface[i];
        }
        const StartColumns<Real> from{hits.point, hits.surface};
        scene.closest_hits(rays.view(), from.view(), hits.view());
    }
    return open;
}

/// Rays from inside a body; every second one is aimed at a rim.
template <class Real>
RayColumns<Real> rays_from_within(const Object& body, int count, std::mt19937_64& random)
{
    const auto& quadric = std::get<Quadric>(body.surface);
    std::uniform_real_distribution<double> unit(0, 1);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto to_world = [&](const glm::dvec3& p) {
        return glm::dvec3(body.transform * glm::dvec4(p, 1));
    };
    RayColumns<Real> rays;
    while (rays.size() < static_cast<std::size_t>(count)) {
        const double share = 0.1 + 0.8 * unit(random);
        const double z = glm::mix(quadric.z_range->low, quadric.z_range->high, share);
        const double turn = 6.2831853 * unit(random);
        const double r = 0.9 * rim_radius(quadric, z) * unit(random);
        // Between the two sheets of a hyperboloid no point is inside.
        if (r == 0)
            continue;
        const glm::dvec3 from = to_world({r * std::cos(turn), r * std::sin(turn), z});
        const bool at_rim = rays.size() % 2 == 0;
        const glm::dvec3 dir = at_rim ? to_world(near_rim(quadric, random)) - from
                                      : glm::dvec3(number(random), number(random), number(random));
        rays.add(from, dir);
    }
    return rays;
}

/// The number of rays that leave the body as often as they enter it; 0 if the body is closed.
template <class Real>
int count_not_left(const RayScene<Real>& scene, const RayColumns<Real>& rays)
{
    int wrong = 0;
    scene.all_hits(rays.view(), [&](std::size_t, std::span<const SurfaceHit<Real>> hits) {
        wrong += hits.size() % 2 == 0;
    });
    return wrong;
}

/// The check on one instruction set for every capped kind.
void check_left_from_within(const std::string& isa, int rays_of_each, std::uint64_t seed)
{
    constexpr int at_once = 100'000;
    std::mt19937_64 random(seed);
    for (const Object& body : capped_bodies(random)) {
        Scene scene{.objects = {body}};
        const RenderOptions options{.isa = isa};
        const RayScene<float> singles(scene, options);
        const RayScene<double> doubles(scene, options);
        int wrong[2] = {};
        for (int done = 0; done < rays_of_each; done += at_once) {
            const int count = std::min(at_once, rays_of_each - done);
            wrong[0] += count_not_left(singles, rays_from_within<float>(body, count, random));
            wrong[1] += count_not_left(doubles, rays_from_within<double>(body, count, random));
        }
        CAPTURE(isa, std::get<Quadric>(body.surface).coefficients);
        CHECK(wrong[0] == 0);
        CHECK(wrong[1] == 0);
    }
}

TEST_CASE("rays from within a capped body leave it once more than they enter it", "[closed_bodies]")
{
    for (const std::string& isa : supported_isas())
        check_left_from_within(isa, 4000, 31);
}

// PACKTRACE_CLOSED_RAYS sets a number of rays larger than the suite has time for, such as ten
// million.
TEST_CASE("many rays from within a capped body leave it once more than they enter it",
          "[closed_bodies][slow]")
{
    const char* const wanted = std::getenv("PACKTRACE_CLOSED_RAYS");
    check_left_from_within(choose_isa().name, wanted != nullptr ? std::atoi(wanted) : 200'000, 32);
}

TEST_CASE("paths that continue from hits at rims leave every capped body they enter",
          "[closed_bodies]")
{
    for (const std::string& isa : supported_isas()) {
        std::mt19937_64 random(11);
        for (const Object& body : capped_bodies(random)) {
            Scene scene{.objects = {body}};
            const RenderOptions options{.isa = isa};
            const RayColumns<float> singles = rays_at_rims<float>(body, 3000, random);
            const RayColumns<double> doubles = rays_at_rims<double>(body, 3000, random);
            CAPTURE(isa, std::get<Quadric>(body.surface).coefficients);
            CHECK(count_open_paths(RayScene<float>(scene, options), singles) == 0);
            CHECK(count_open_paths(RayScene<double>(scene, options), doubles) == 0);
        }
    }
}

TEST_CASE("a line that only touches a rim hits it twice or misses it", "[closed_bodies]")
{
    Scene scene{.objects = {capped_cylinder()}};
    std::vector<RenderOptions> all(1);
    all[0].kernel = Kernel::scalar;
    for (const std::string& isa : supported_isas())
        for (const Accuracy accuracy : {Accuracy::fast, Accuracy::exact}) {
            all.emplace_back();
            all.back().isa = isa;
            all.back().accuracy = accuracy;
        }
    for (const RenderOptions& options : all)
        for (const double side : {1.0, -1.0})
            for (const double cap : {1.0, -1.0}) {
                CAPTURE(options.isa, side, cap);
                // Past the rim at (side, 0, cap), downwards and upwards.
                CHECK(count_hits<float>(scene, options, {0, 0, 2 * cap}, {side, 0, -cap}) == 2);
                CHECK(count_hits<double>(scene, options, {0, 0, 2 * cap}, {side, 0, -cap}) == 2);
                CHECK(count_hits<double>(scene, options, {2 * side, 0, 0}, {-side, 0, cap}) == 2);
                // Through the rim and the body.
                CHECK(count_hits<double>(scene, options, {2 * side, 0, 2 * cap},
                                         {-side, 0, -cap}) == 2);
            }
}

}  // namespace packtrace::test
