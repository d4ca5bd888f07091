// The truth that stress holds kernels against, and what it finds.
#include "study/stress.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "run_program.hpp"
#include "study/judge.hpp"
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
