// Capped bodies are closed for packets too: rays from inside leave once more than they enter, lines
// from outside leave as often as they enter, at rims as well.
#include <array>
#include <limits>

#include <packtrace/intersect.hpp>

#include "catch.hpp"
#include "reference_scenes.hpp"
#include "render_scene.hpp"
#include "study/stress.hpp"

namespace packtrace::test {
namespace {

template <class Real>
using Columns = std::array<std::vector<Real>, 8>;

template <class Real>
RaysView<Real> view_of(const Columns<Real>& c)
{
    return {c[0].data(), c[1].data(), c[2].data(), c[3].data(), c[4].data(),
            c[5].data(), c[6].data(), c[7].data(), c[0].size()};
}

template <class Real>
void add_ray(Columns<Real>& columns, const Vec3& org, const Vec3& dir)
{
    const double values[8] = {org.x, org.y, org.z, dir.x,
                              dir.y, dir.z, 0.0,   std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < 8; ++i)
        columns[i].push_back(static_cast<Real>(values[i]));
}

/// How many hits the endless ray has in all.
template <class Real>
std::size_t count_hits(const Scene& scene, const RenderOptions& options, const Vec3& org,
                       const Vec3& dir)
{
    Columns<Real> rays;
    add_ray<Real>(rays, org, dir);
    std::size_t count = 0;
    RayScene<Real>(scene, options)
        .all_hits(view_of(rays), [&](std::size_t, std::span<const SurfaceHit<Real>> hits) {
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

/// Every capped kind, from inside and from outside, half of the rays at rims.
void check_closed(int rays, std::uint64_t seed)
{
    study::StressOptions options;
    options.rays = rays;
    options.seed = seed;
    options.kernels = {"packet", "scalar"};
    options.modes = {"exact"};
    options.families = {"closed-bodies", "rims-outside"};
    study::run_stress(options, [](const std::vector<study::StressRow>& rows) {
        for (const study::StressRow& row : rows) {
            CAPTURE(row.family, row.precision, row.kernel, row.isa, row.example);
            if (row.kernel == "packet" || row.precision == "double") {
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

TEST_CASE("half a million rays leave capped bodies as often as they enter them",
          "[closed_bodies][slow]")
{
    for (const std::uint64_t seed : {21u, 22u, 23u})
        check_closed(80000, seed);
}

TEST_CASE("a line that only touches a rim has two hits there, or none", "[closed_bodies]")
{
    Scene scene;
    scene.objects = {capped_cylinder()};
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
                // Past the rim at (side, 0, cap), down to it and up to it.
                CHECK(count_hits<float>(scene, options, {0, 0, 2 * cap}, {side, 0, -cap}) == 2);
                CHECK(count_hits<double>(scene, options, {0, 0, 2 * cap}, {side, 0, -cap}) == 2);
                CHECK(count_hits<double>(scene, options, {2 * side, 0, 0}, {-side, 0, cap}) == 2);
                // Through the rim and the body.
                CHECK(count_hits<double>(scene, options, {2 * side, 0, 2 * cap},
                                         {-side, 0, -cap}) == 2);
            }
}

}  // namespace packtrace::test
