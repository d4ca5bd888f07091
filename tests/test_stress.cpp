// The truth that stress holds kernels against, and what it finds.
#include "study/stress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "run_program.hpp"
#include "study/judge.hpp"
#include "study/own_surface.hpp"
#include "study/stress_family.hpp"

namespace packtrace::test {
namespace {

using study::Meeting;
using study::StressRay;
using study::StressRow;
using study::WideSurface;

std::vector<Meeting> meetings(const Object& object, const StressRay& ray)
{
    std::vector<Meeting> found;
    study::find_meetings(WideSurface(object, 0), ray, found);
    std::sort(found.begin(), found.end(),
              [](const Meeting& a, const Meeting& b) { return a.t < b.t; });
    return found;
}

std::vector<StressRow> rows_of(const study::StressOptions& options)
{
    std::vector<StressRow> rows;
    study::run_stress(options, [&](const std::vector<StressRow>& some) {
        rows.insert(rows.end(), some.begin(), some.end());
    });
    return rows;
}

/// A cylinder, and a ray that is along it to within its own rounding and passes it by.
Object turned_cylinder()
{
    Object cylinder;
    cylinder.surface = study::quadric_of(QuadricKind::cylinder);
    cylinder.transform[0] = {-0x1.c5519ep-8, 0x1.0dcd44p-1, 0x1.b9b048p-2, 0.0};
    cylinder.transform[1] = {0x1.f23074p-3, 0x1.2d71f2p-1, -0x1.753a46p-1, 0.0};
    cylinder.transform[2] = {-0x1.c9e65ep-1, 0x1.f19edep-3, -0x1.06e96ep-3, 0.0};
    cylinder.transform[3] = {0x1.7b42bap+1, 0x1.caff8ap+0, -0x1.4e173p+0, 1.0};
    return cylinder;
}
StressRay ray_along_cylinder()
{
    return {{0x1.7b8a0ap+2, -0x1.16d2aap-8, 0x1.70e8a8p-1},
            {-0x1.e96a8ep-1, 0x1.09ef78p-2, -0x1.1901eep-3},
            0.0,
            std::numeric_limits<double>::infinity()};
}

/// Whether a change of the ray's direction by no more than `change` of each component makes it
/// meet the object.
bool meets_after(const Object& object, const StressRay& ray, double change)
{
    for (int which = 0; which < 27; ++which) {
        StressRay other = ray;
        int digits = which;
        for (int axis = 0; axis < 3; ++axis, digits /= 3)
            other.dir[axis] *= 1.0 + change * (digits % 3 - 1);
        for (const Meeting& meeting : meetings(object, other))
            if (meeting.exists)
                return true;
    }
    return false;
}

const StressRow& row_of(const std::vector<StressRow>& rows, const std::string& kernel,
                        const std::string& mode)
{
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const StressRow& r) {
        return r.kernel == kernel && r.mode == mode;
    });
    REQUIRE(row != rows.end());
    return *row;
}

}  // namespace

TEST_CASE("the truth about a ray through a sphere is known", "[stress]")
{
    const Object ball = study::sphere_object({0, 0, 10}, 2);
    const StressRay through{{0, 0, 0}, {0, 0, 1}, 0.0, 1e9};
    const auto both = meetings(ball, through);
    REQUIRE(both.size() == 2);
    CHECK(both[0].exists);
    CHECK(both[1].exists);
    CHECK(both[0].t == 8);
    CHECK(both[1].t == 12);
    CHECK(both[0].normal.z == -1);
    CHECK(both[0].margin > 0.01);
    // (|t d| + |c|) / t along the normal, no component of the origin.
    CHECK(both[0].condition == Approx((8.0 + 10.0) / 8.0));
}

TEST_CASE("the truth tells how near a ray is to missing", "[stress]")
{
    const Object ball = study::sphere_object({0, 0, 10}, 2);
    for (const double off : {1e-3, 1e-6, 1e-9}) {
        CAPTURE(off);
        const auto inside = meetings(ball, {{2.0 - off, 0, 0}, {0, 0, 1}, 0.0, 1e9});
        REQUIRE(inside.size() == 2);
        CHECK(inside[0].exists);
        CHECK(inside[0].margin < off);
        CHECK(inside[0].margin > off / 20);
        const auto outside = meetings(ball, {{2.0 + off, 0, 0}, {0, 0, 1}, 0.0, 1e9});
        REQUIRE(outside.size() == 1);
        CHECK_FALSE(outside[0].exists);
        CHECK(outside[0].margin < off);
        CHECK(outside[0].margin > off / 20);
    }
}

TEST_CASE("a judge finds a wrong hit, a wrong miss and a wrong place", "[stress]")
{
    const Object ball = study::sphere_object({0, 0, 10}, 2);
    const std::vector<WideSurface> surfaces = {WideSurface(ball, 0)};
    const StressRay through{{0, 0, 0}, {0, 0, 1}, 0.0, 1e9};
    const StressRay past{{3, 0, 0}, {0, 0, 1}, 0.0, 1e9};
    const auto errors = [&](const StressRay& ray, const study::Answer& answer) {
        study::Judge judge(surfaces, 0x1p-24);
        judge.judge(ray, meetings(ball, ray), answer);
        return judge.errors();
    };
    CHECK(errors(through, {0, 8.0, {0, 0, -1}}).wrong == 0);
    CHECK(errors(through, {0, 8.0, {0, 0, -1}}).rho == 0.0);
    CHECK(errors(through, {-1, 1e9, {}}).wrong == 1);
    CHECK(errors(through, {0, 12.0, {0, 0, 1}}).wrong == 1);
    CHECK(errors(past, {-1, 1e9, {}}).wrong == 0);
    CHECK(errors(past, {0, 10.0, {1, 0, 0}}).wrong == 1);
    CHECK(errors(through, {0, 8.001, {0, 0, -1}}).rho > 100.0);
    CHECK(errors(through, {0, 8.0, {0, 0, std::nan("")}}).not_finite == 1);
}

TEST_CASE("a ray that its own rounding turns towards a cylinder is inside the band", "[stress]")
{
    const double band = study::undecidable_band * 0x1p-24;
    const auto along = meetings(turned_cylinder(), ray_along_cylinder());
    REQUIRE(along.size() == 1);
    CHECK(!along[0].exists);
    CHECK(meets_after(turned_cylinder(), ray_along_cylinder(), 0x1p-24));
    CHECK(along[0].margin < band);
    // Ten thousand times further off the axis it is decided, until its range ends.
    StressRay off = ray_along_cylinder();
    off.dir += 1e-3 * Vec3(turned_cylinder().transform[0]);
    for (const Meeting& meeting : meetings(turned_cylinder(), off))
        CHECK((meeting.exists || meeting.margin > band));
    StressRay short_one = ray_along_cylinder();
    short_one.t_max = 10.0;
    CHECK(meetings(turned_cylinder(), short_one)[0].margin > band);
}

TEST_CASE("packets are right about rays along a cylinder outside the band", "[stress]")
{
    study::StressOptions options;
    options.rays = 24000;
    options.kernels = {"packet"};
    options.precisions = {"single"};
    options.families = {"cylinder-axis"};
    for (const StressRow& row : rows_of(options)) {
        CAPTURE(row.mode, row.isa);
        CHECK(row.wrong == 0);
        CHECK(row.undecidable < row.rays / 2);
    }
}

TEST_CASE("second meetings are those of rays from where they start", "[stress]")
{
    study::StressOptions options;
    options.rays = 8000;
    options.kernels = {"packet"};
    options.families = {"cone-apex", "far-quadric"};
    for (const StressRow& row : rows_of(options)) {
        CAPTURE(row.family, row.precision, row.mode, row.isa);
        CHECK(row.secondary > 1000);
        CHECK(row.exact_taken == 0);
        CHECK(row.exact_lost == 0);
    }
}

TEST_CASE("packets keep every stated bound on every family", "[stress]")
{
    study::StressOptions options;
    options.rays = 400;
    options.kernels = {"packet"};
    for (const StressRow& row : rows_of(options)) {
        CAPTURE(row.family, row.precision, row.mode, row.isa, row.broken);
        CHECK(row.broken.empty());
    }
}

TEST_CASE("the textbook breaks on what packets hold", "[stress]")
{
    study::StressOptions options;
    options.rays = 1000;
    options.precisions = {"single"};
    options.families = {"tiny-far"};
    const auto far = rows_of(options);
    CHECK(row_of(far, "naive", "").wrong > 100);
    CHECK(row_of(far, "packet", "fast").wrong == 0);
    options.families = {"ground-5000"};
    const auto ground = rows_of(options);
    CHECK(row_of(ground, "naive", "").ulp_max > 1e4);
    CHECK(row_of(ground, "packet", "fast").ulp_max < 200.0);
    CHECK(row_of(ground, "packet", "auto").ulp_max < 4.0);
}

TEST_CASE("all instruction sets with fused multiply-add answer alike in every mode", "[stress]")
{
    study::StressOptions options;
    options.rays = 300;
    options.kernels = {"packet"};
    for (const StressRow& row : rows_of(options)) {
        CAPTURE(row.family, row.precision, row.mode, row.isa);
        // One row without, and one row for all with it.
        const bool plain = row.isa.find("sse42") != std::string::npos;
        const bool fused = row.isa.find("avx2") != std::string::npos;
        CHECK((plain || row.isa.find("sse_fma") != std::string::npos) == (plain || fused));
    }
}

TEST_CASE("the stress command prints rows, JSON and its families", "[stress]")
{
    const std::vector<std::string> few = {"stress", "--family", "sphere", "--rays", "64"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), few.begin(), few.end());
        return run_packtrace(more);
    };
    const ProgramResult table = with({"--kernel", "packet", "--mode", "robust"});
    CHECK(table.exit_code == 0);
    CHECK(table.out.find("sphere") != std::string::npos);
    CHECK(table.out.find("robust") != std::string::npos);
    CHECK(table.out.find("fast") == std::string::npos);

    const auto json = nlohmann::json::parse(with({"--json", "--precision", "single"}).out);
    CHECK(json.at("rays_per_family") == 64);
    CHECK(json.at("rows").size() >= 3);
    for (const auto& row : json.at("rows")) {
        CHECK(row.at("family") == "sphere");
        CHECK(row.at("precision") == "single");
        CHECK(row.at("rays") == 64);
    }

    const ProgramResult list = run_packtrace({"stress", "--list"});
    CHECK(list.exit_code == 0);
    for (const auto& family : study::list_stress_families())
        CHECK(list.out.find(family.name) != std::string::npos);
    CHECK(run_packtrace({"stress", "--family", "nonsense"}).exit_code == 2);
    CHECK(run_packtrace({"stress", "--rays", "0"}).exit_code == 2);
}

TEST_CASE("accuracy is refused where it means nothing", "[stress]")
{
    const std::string scene = PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene";
    const auto render_with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"render", scene, "-o", "/nowhere/x.png"});
        return run_packtrace(more);
    };
    const ProgramResult scalar = render_with({"--kernel", "scalar", "--accuracy", "robust"});
    CHECK(scalar.exit_code == 2);
    CHECK(scalar.err.find("--accuracy") != std::string::npos);
    const ProgramResult doubles = render_with({"--precision", "double", "--accuracy", "fast"});
    CHECK(doubles.exit_code == 2);
}

}  // namespace packtrace::test
