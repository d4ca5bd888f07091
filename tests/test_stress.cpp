// The truth that stress compares kernels with, and its findings.
#include "catch.hpp"
#include "killed_program.hpp"
#include "lab/stress/evaluate.hpp"
#include "lab/stress/placed_quadric.hpp"
#include "lab/stress/stress.hpp"
#include "lab/stress/stress_family.hpp"
#include "lab/stress/stress_subject.hpp"
#include "render/option_words.hpp"
#include "run_program.hpp"
#include "temp_folder.hpp"
#include <packtrace/isa.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace packtrace::test {
namespace {

using lab::Expected;
using lab::StressRay;
using lab::StressRow;
using lab::TrueHit;
using lab::Verdict;
using lab::WideSurface;

constexpr double single_roundoff = 0x1p-24;

std::vector<TrueHit> true_hits(const Object& object, const StressRay& ray)
{
    std::vector<TrueHit> found;
    lab::find_true_hits(WideSurface(object, 0), ray, found);
    std::sort(found.begin(), found.end(),
              [](const TrueHit& a, const TrueHit& b) { return a.t < b.t; });
    return found;
}

Expected expected_of(const std::vector<Object>& objects, const StressRay& ray)
{
    std::vector<TrueHit> hits;
    for (std::size_t i = 0; i < objects.size(); ++i)
        lab::find_true_hits(WideSurface(objects[i], static_cast<std::int32_t>(i)), ray, hits);
    return lab::expect(ray, std::move(hits), single_roundoff);
}

Verdict verdict_of(const Expected& expected, const lab::Answer& answer)
{
    return lab::verdict_of(expected, answer, lab::double_band, single_roundoff);
}

lab::Errors errors_of(const Expected& expected, const StressRay& ray, const lab::Answer& answer)
{
    lab::Evaluation evaluation(single_roundoff);
    evaluation.add(ray, expected, answer);
    return evaluation.errors();
}

StressRay endless(const Vec3& org, const Vec3& dir)
{
    return {org, dir, 0.0, lab::no_end};
}

std::vector<StressRow> rows_of(const lab::StressOptions& options)
{
    std::vector<StressRow> rows;
    lab::run_stress(options, [&](const std::vector<StressRow>& some) {
        rows.insert(rows.end(), some.begin(), some.end());
    });
    return rows;
}

/// A cylinder; ray_along_cylinder() runs along it, to within the rounding of the ray, and misses
/// it.
Object turned_cylinder()
{
    Object cylinder{.surface = packtrace::quadric(QuadricKind::cylinder)};
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

/// Whether the ray hits the object after a change of each component of its direction by at most
/// this share.
bool meets_after(const Object& object, const StressRay& ray, double change)
{
    for (int which = 0; which < 27; ++which) {
        StressRay other = ray;
        int digits = which;
        for (int axis = 0; axis < 3; ++axis, digits /= 3)
            other.dir[axis] *= 1.0 + change * (digits % 3 - 1);
        for (const TrueHit& hit : true_hits(object, other))
            if (hit.exists)
                return true;
    }
    return false;
}

/// Checks all families in exact mode and in packets of doubles, on the widest instruction set. All
/// instruction sets with fused multiply-add give the same answers.
void check_faultless(lab::StressOptions options)
{
    options.isa = choose_isa("auto").name;
    options.kernels = {"packet"};
    options.modes = {"exact"};
    for (const StressRow& row : rows_of(options)) {
        CAPTURE(row.family, language::word_of(row.precision), row.isa, row.example);
        CHECK(row.held);
        CHECK(row.faults == std::vector<std::string>{});
    }
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
    const Object ball = lab::sphere_object({0, 0, 10}, 2);
    const StressRay through{{0, 0, 0}, {0, 0, 1}, 0.0, 1e9};
    const auto both = true_hits(ball, through);
    REQUIRE(both.size() == 2);
    CHECK(both[0].exists);
    CHECK(both[1].exists);
    CHECK(both[0].t == 8);
    CHECK(both[1].t == 12);
    CHECK(both[0].normal.z == -1);
    CHECK(both[0].margin > 0.01);
    // (|t d| + |c|) / t along the normal; the origin has no component there.
    CHECK(both[0].condition == Approx((8.0 + 10.0) / 8.0));
}

TEST_CASE("the truth includes how close a ray is to missing", "[stress]")
{
    const Object ball = lab::sphere_object({0, 0, 10}, 2);
    for (const double off : {1e-3, 1e-6, 1e-9}) {
        CAPTURE(off);
        const auto inside = true_hits(ball, {{2.0 - off, 0, 0}, {0, 0, 1}, 0.0, 1e9});
        REQUIRE(inside.size() == 2);
        CHECK(inside[0].exists);
        CHECK(inside[0].margin < off);
        CHECK(inside[0].margin > off / 20);
        const auto outside = true_hits(ball, {{2.0 + off, 0, 0}, {0, 0, 1}, 0.0, 1e9});
        REQUIRE(outside.size() == 1);
        CHECK_FALSE(outside[0].exists);
        CHECK(outside[0].margin < off);
        CHECK(outside[0].margin > off / 20);
    }
}

TEST_CASE("an answer is compared with the hit that was expected before", "[stress]")
{
    const Object ball = lab::sphere_object({0, 0, 10}, 2);
    const Object behind = lab::sphere_object({0, 0, 20}, 2);
    const StressRay through = endless({0, 0, 0}, {0, 0, 1});
    const Expected expected = expected_of({ball, behind}, through);
    CHECK(expected.object == 0);
    CHECK(expected.t == 8);
    CHECK(expected.normal.z == -1.0);
    CHECK(expected.cosine == -1.0);
    CHECK(verdict_of(expected, {0, 8.0, {0, 0, -1}}) == Verdict::right);
    CHECK(verdict_of(expected, {-1, 0.0, {}}) == Verdict::lost);
    CHECK(verdict_of(expected, {0, 12.0, {0, 0, 1}}) == Verdict::wrong_root);
    CHECK(verdict_of(expected, {1, 18.0, {0, 0, -1}}) == Verdict::wrong_object);
    const Expected miss = expected_of({ball}, endless({3, 0, 0}, {0, 0, 1}));
    CHECK(miss.object == -1);
    CHECK(verdict_of(miss, {-1, 0.0, {}}) == Verdict::right);
    CHECK(verdict_of(miss, {0, 10.0, {1, 0, 0}}) == Verdict::false_hit);
    // The answer is far off, but closer to no other hit: the right hit with a wrong t.
    CHECK(errors_of(expected, through, {0, 8.001, {0, 0, -1}}).wrong() == 0);
    CHECK(errors_of(expected, through, {0, 8.001, {0, 0, -1}}).t_beyond == 1);
}

TEST_CASE("t, normals and numbers that are wrong are counted", "[stress]")
{
    const Object ball = lab::sphere_object({0, 0, 10}, 2);
    const StressRay through = endless({0, 0, 0}, {0, 0, 1});
    const Expected expected = expected_of({ball}, through);
    const auto errors = [&](const lab::Answer& answer) {
        return errors_of(expected, through, answer);
    };
    CHECK(errors({0, 8.0, {0, 0, -1}}).rho == 0.0);
    CHECK(errors({0, 8.0, {0, 0, -1}}).t_beyond_half == 0);
    CHECK(errors({0, 8.0 + 0x1p-20, {0, 0, -1}}).ulp == std::vector<float>{1.0f});
    CHECK(errors({0, 8.0 + 0x1p-20, {0, 0, -1}}).t_beyond == 0);
    CHECK(errors({0, 8.0 + 0x1p-20, {0, 0, -1}}).t_beyond_half == 1);
    CHECK(errors({0, 8.0 + 0x1p-19, {0, 0, -1}}).t_beyond == 1);
    CHECK(errors({0, 8.0, {0, 0, 0}}).no_normal == 1);
    CHECK(errors({0, 8.0, {0, 0, 1}}).wrong_side == 1);
    CHECK(errors({0, 8.0, {0.6, 0, -0.8}}).normal == std::vector<float>{0.6f});
    CHECK(errors({0, 8.0, {0.6, 0, -0.8}}).normal_beyond == 1);
    CHECK(errors({0, 8.0, {0, 0, -1}}).normal_beyond == 0);
    CHECK(errors({0, 8.0, {0, 0, std::nan("")}}).not_finite == 1);
    CHECK(errors({0, std::nan(""), {0, 0, -1}}).not_finite == 1);
}

TEST_CASE("if both roots are one float the normal identifies the far side", "[stress]")
{
    const Object ball = lab::sphere_object({0, 0, 10000}, static_cast<double>(0.0003f));
    const auto small = static_cast<double>(1e-8f);
    const Expected expected = expected_of({ball}, endless({0, 0, 0}, {small, small, 1}));
    CHECK(expected.root_decided(lab::double_band));
    CHECK(static_cast<float>(expected.t) == 10000.0f);
    CHECK(expected.normal.z == Approx(-0.881917));
    const double third = 1.0 / 3.0;
    CHECK(verdict_of(expected, {0, 10000.0, {third, third, -0.8819171}}) == Verdict::right);
    CHECK(verdict_of(expected, {0, 10000.0, {third, third, 0.8819171}}) == Verdict::wrong_root);
}

TEST_CASE("which of two objects is first is decided as far as double can", "[stress]")
{
    // A ball of radius 2 before another whose hit is `gap` further away.
    for (const double gap : {1e-3, 1e-9, 1e-14, 1e-17}) {
        CAPTURE(gap);
        std::vector<TrueHit> hits(2);
        for (TrueHit& hit : hits) {
            hit.exists = true;
            hit.t = 8;
            hit.object = static_cast<std::int32_t>(&hit - hits.data());
            hit.normal = {0, 0, -1};
            hit.spread = 18.0;
            hit.condition = hit.spread / 8.0;
            hit.margin = 1.0;
        }
        hits[1].t += lab::Wide(gap);
        const Expected expected = lab::expect(endless({0, 0, 0}, {0, 0, 1}), hits, 0x1p-24);
        CHECK(expected.object == 0);
        CHECK(expected.margin == Approx(gap / 36.0));
        const bool told = gap > 1e-13;
        CHECK(expected.decided(lab::double_band) == told);
        CHECK(verdict_of(expected, {1, 8.0, {0, 0, -1}}) ==
              (told ? Verdict::wrong_object : Verdict::right));
    }
}

TEST_CASE("for a ray along a plane the hit is not decided", "[stress]")
{
    const auto at = [](const Vec3& point, const Vec3& normal) -> Object {
        return {.surface = Plane{point, normal}};
    };
    // The hit of the first plane at 4.7 comes from numbers of which double loses all digits. The
    // range ends before it, and the second plane is hit at 1.1.
    const Object along = at({-1.9695611906237829, -0.41843472844922847, -0.0930777920808108},
                            {0.1474537127369533, -0.9770021895775972, 0.15402637488647472});
    const Object across = at({1.1753415959903997, 0.5997598098087433, -0.7454016051536279},
                             {-0.23209158766088164, 0.9703913323236328, -0.06688914028611945});
    const StressRay ray{{-3.2434735724271127, -0.85100984979313821, -1.6173864079549822},
                        {-1.2999306949646252, 0.12771969718538334, 2.0545963722694749},
                        0.0,
                        1.6748107610565417};
    const Expected expected = expected_of({along, across}, ray);
    CHECK(expected.object == 1);
    CHECK(static_cast<double>(expected.t) == Approx(1.1238928938108266));
    CHECK_FALSE(expected.decided(lab::double_band));
    CHECK(expected_of({across}, ray).decided(lab::double_band));
}

TEST_CASE("every ray hits intersecting planes, on their edge as well", "[stress]")
{
    Object planes{.surface = Quadric{.coefficients = {1, 0, -1, 0, 0, 0, 0, 0, 0, 0}}};
    const Expected edge = expected_of({planes}, endless({0, 0, -5}, {0, 0.04, 0.2}));
    CHECK(edge.object == 0);
    CHECK(static_cast<double>(edge.t) == Approx(25.0));
    CHECK(edge.decided(lab::double_band));
    CHECK_FALSE(edge.root_decided(lab::double_band));
    CHECK(verdict_of(edge, {-1, 0.0, {}}) == Verdict::lost);
    CHECK(verdict_of(edge, {0, 25.0, {1, 0, 0}}) == Verdict::right);
    // x = -z first, at z = -2: before it x² < z², inside.
    const Expected off = expected_of({planes}, endless({2, 0, -5}, {0, 0, 1}));
    CHECK(off.t == 3);
    CHECK(off.normal.x == Approx(std::sqrt(0.5)));
    CHECK(off.normal.z == Approx(std::sqrt(0.5)));
    CHECK(off.root_decided(lab::double_band));
}

TEST_CASE("a ray inside a capped body has to leave it, at its rim as well", "[stress]")
{
    Quadric quadric = packtrace::quadric(QuadricKind::cylinder);
    quadric.z_range = ZRange{-1.0, 1.0};
    quadric.capped = true;
    Object cylinder{.surface = quadric};
    const auto at_rim = [&](double z) {
        Expected expected = expected_of({cylinder}, endless({0, 0, 0}, {1, 0, z}));
        expected.certain = true;
        return expected;
    };
    CHECK(at_rim(1.0).object == 0);
    CHECK(at_rim(1.0).t == 1);
    CHECK_FALSE(at_rim(1.0).decided(lab::double_band));
    CHECK(verdict_of(at_rim(1.0), {-1, 0.0, {}}) == Verdict::lost);
    CHECK(verdict_of(at_rim(1.0), {0, 1.0, {0, 0, 1}}) == Verdict::right);
    CHECK(verdict_of(at_rim(1.0), {0, 1.0, {1, 0, 0}}) == Verdict::right);
    CHECK(verdict_of(at_rim(1.0 + 1e-6), {0, 1.0, {1, 0, 0}}) == Verdict::wrong_root);
    CHECK(at_rim(0.5).decided(lab::double_band));

    const auto not_closed = [&](double z, std::size_t crossings) {
        lab::Evaluation evaluation(single_roundoff);
        evaluation.add_crossings(at_rim(z), crossings);
        return evaluation.errors().not_closed;
    };
    CHECK(not_closed(1.0, 0) == 1);
    CHECK(not_closed(1.0, 1) == 0);
    CHECK(not_closed(1.0, 2) == 1);
    CHECK(not_closed(0.5, 1) == 0);
    CHECK(not_closed(0.5, 3) == 1);

    const auto not_even = [&](const Vec3& org, const Vec3& dir, std::size_t crossings) {
        Expected expected = expected_of({cylinder}, endless(org, dir));
        expected.even = true;
        lab::Evaluation evaluation(single_roundoff);
        evaluation.add_crossings(expected, crossings);
        return evaluation.errors().not_closed;
    };
    for (const std::size_t crossings : {0u, 2u})
        CHECK(not_even({0, 0, 2}, {1, 0, -1}, crossings) == 0);
    for (const std::size_t crossings : {1u, 3u})
        CHECK(not_even({0, 0, 2}, {1, 0, -1}, crossings) == 1);
    CHECK(not_even({0, 0, 2}, {0.25, 0, -1}, 2) == 0);
    CHECK(not_even({0, 0, 2}, {0.25, 0, -1}, 0) == 1);
}

TEST_CASE("any-hit answers and the first of all hits are compared with the truth", "[stress]")
{
    const Object ball = lab::sphere_object({0, 0, 10}, 2);
    const Expected hit = expected_of({ball}, endless({0, 0, 0}, {0, 0, 1}));
    const Expected miss = expected_of({ball}, endless({3, 0, 0}, {0, 0, 1}));
    lab::Evaluation evaluation(single_roundoff);
    evaluation.add_occluded(hit, true);
    evaluation.add_occluded(miss, false);
    evaluation.add_first_of_all(hit, 0, 0);
    CHECK(evaluation.errors().occluded == 0);
    CHECK(evaluation.errors().order == 0);
    evaluation.add_occluded(hit, false);
    evaluation.add_occluded(miss, true);
    evaluation.add_first_of_all(hit, 1, 0);
    CHECK(evaluation.errors().occluded == 2);
    CHECK(evaluation.errors().order == 1);
}

TEST_CASE("a ray along a cone's side has one hit, and none at infinity", "[stress]")
{
    Object cone{.surface = packtrace::quadric(QuadricKind::cone)};
    StressRay ray = endless({0, 2, 0}, {0, 1, 1});
    ray.exact = true;
    // y² - z² = (2 + t)² - t² = 4 + 4 t.
    const Expected behind = expected_of({cone}, ray);
    CHECK(behind.object == -1);
    CHECK(verdict_of(behind, {0, 6e16, {0, 1, -1}}) == Verdict::false_hit);
    ray.dir = -ray.dir;
    CHECK(expected_of({cone}, ray).t == 1);
}

TEST_CASE("among many spheres the truth skips none that matters", "[stress]")
{
    for (const lab::StressFamily& family : lab::touching_families()) {
        if (family.name != "creases-100" && family.name != "creases-1000")
            continue;
        for (const lab::StressGroup& group : lab::make_groups<float>(family, 7, 64))
            for (std::size_t i = 0; i < group.rays.size(); ++i) {
                CAPTURE(family.name, i);
                const Expected all = expected_of(group.scene.objects, group.rays[i]);
                const Expected& some = group.expected[i];
                CHECK(some.object == all.object);
                CHECK(some.t == all.t);
                // Beyond the band the margins may be those of other far objects.
                CHECK(std::min(some.margin, 1e-6) == std::min(all.margin, 1e-6));
            }
    }
}

TEST_CASE("known findings come first in their families", "[stress]")
{
    int known = 0;
    for (const lab::StressFamily& family : lab::stress_families())
        for (const auto& make : family.known) {
            CAPTURE(family.name);
            lab::StressRandom random(1);
            const lab::StressCase one = make();
            CHECK_FALSE(one.scene.objects.empty());
            CHECK(expected_of(one.scene.objects, one.ray(random)).object >= -1);
            ++known;
        }
    CHECK(known >= 6);
}

TEST_CASE("the square root of 113 bits is right to the last bit", "[stress]")
{
    for (const double x : {4.0, 2.0, 1e-300, 3e300, 4e-308, 0.1}) {
        const lab::Wide root = lab::square_root(lab::Wide(x));
        const lab::Wide off = magnitude(root * root - x) / x;
        CHECK(static_cast<double>(off) < 0x1p-110);
    }
    CHECK(lab::square_root(lab::Wide(9)) == 3);
    CHECK(lab::square_root(lab::Wide(-1)) == 0);
}

TEST_CASE("a verdict names the families with wrong answers", "[stress]")
{
    StressRow good;
    good.family = "sphere";
    good.precision = Precision::single;
    good.mode = "exact";
    good.held = true;
    good.rays = 100;
    CHECK(lab::faults_of(good).empty());
    CHECK(lab::without_faults({good}));
    CHECK(lab::stress_verdict({good}) ==
          "verdict: exact is right in the family " + good.family +
              " (0 wrong decisions, 0 self-hits, 0 second hits lost, 100 rays)");
    StressRow bad = good;
    bad.family = "rims";
    bad.wrong = bad.lost = 3;
    bad.faults = lab::faults_of(bad);
    CHECK(bad.faults == std::vector<std::string>{"3 lost"});
    CHECK_FALSE(lab::without_faults({good, bad}));
    CHECK(lab::stress_verdict({good, bad}) ==
          "verdict: exact is WRONG in rims: 3 lost (3 wrong decisions, 0 self-hits, 0 second hits "
          "lost, 200 rays)");
    StressRow bounded = good;
    bounded.bounds = 300;
    CHECK(lab::stress_verdict({bounded}) ==
          "verdict: exact is right in the family " + good.family +
              " (0 wrong decisions, 0 self-hits, 0 second hits lost, 0 of 300 bounds missed, 100 "
              "rays)");
    // A result beyond the bounds because double has no more digits is named, but is no fault.
    StressRow limit = good;
    limit.family = "far";
    limit.hits = 90;
    limit.t_at_limit = 2;
    limit.normal_beyond = 1;
    CHECK(lab::faults_of(limit).empty());
    CHECK(lab::stress_verdict({good, limit}) ==
          "verdict: exact is right in all 2 families (0 wrong decisions, 0 self-hits, 0 second "
          "hits lost, 200 rays), double itself at its limit in far (2 t, 1 normals of 90)");
    // Packets of doubles do not refine: an error of an ulp of double is no fault, an error beyond
    // that of the inputs is.
    StressRow doubles = good;
    doubles.precision = Precision::double_;
    doubles.hits = 100;
    doubles.t_beyond = doubles.t_beyond_half = 50;
    doubles.rho = 3.9;
    CHECK(lab::faults_of(doubles).empty());
    doubles.rho = 4.1;
    CHECK(lab::faults_of(doubles).size() == 1);
    // Without fused operations products have their own rounding errors.
    doubles.isa = "sse42";
    CHECK(lab::faults_of(doubles).empty());
    doubles.rho = 8.1;
    CHECK(lab::faults_of(doubles).size() == 1);
    StressRow fast = bad;
    fast.held = false;
    fast.faults.clear();
    CHECK(lab::stress_verdict({fast}) == "verdict: no rays were traced in an exact mode");
    for (const auto count : std::initializer_list<std::uint64_t StressRow::*>{
             &StressRow::false_hits, &StressRow::wrong_object, &StressRow::wrong_root,
             &StressRow::occluded, &StressRow::order, &StressRow::not_closed,
             &StressRow::beyond_own_band, &StressRow::not_finite, &StressRow::no_normal,
             &StressRow::wrong_side, &StressRow::t_beyond, &StressRow::t_beyond_half,
             &StressRow::self_hits, &StressRow::second_lost, &StressRow::second_inexact,
             &StressRow::bounds_missed}) {
        StressRow row = good;
        row.*count = 1;
        CHECK(lab::faults_of(row).size() == 1);
    }
}

TEST_CASE("a ray that its own rounding may turn towards a cylinder is inside the band", "[stress]")
{
    const double band = lab::undecided_band * 0x1p-24;
    const auto along = true_hits(turned_cylinder(), ray_along_cylinder());
    REQUIRE(along.size() == 1);
    CHECK(!along[0].exists);
    CHECK(meets_after(turned_cylinder(), ray_along_cylinder(), 0x1p-24));
    CHECK(along[0].margin < band);
    // Ten thousand times further off the axis, the miss is decided until the ray interval ends.
    StressRay off = ray_along_cylinder();
    off.dir += 1e-3 * Vec3(turned_cylinder().transform[0]);
    for (const TrueHit& hit : true_hits(turned_cylinder(), off))
        CHECK((hit.exists || hit.margin > band));
    StressRay short_one = ray_along_cylinder();
    short_one.t_max = 10.0;
    CHECK(true_hits(turned_cylinder(), short_one)[0].margin > band);
}

TEST_CASE("packets are right about rays along a cylinder outside the band", "[stress]")
{
    const lab::StressOptions options{.families = {"cylinder-axis"},
                                     .kernels = {"packet"},
                                     .precisions = {Precision::single},
                                     .rays = 24000,
                                     .second_hits = false,
                                     .bounds = false};
    for (const StressRow& row : rows_of(options)) {
        CAPTURE(row.mode, row.isa);
        CHECK(row.beyond_own_band == 0);
        CHECK(row.undecided < row.rays / 2);
    }
}

TEST_CASE("second hits are those of rays from their actual starts", "[stress]")
{
    const lab::StressOptions options{.families = {"cone-apex", "far-quadric"},
                                     .kernels = {"packet"},
                                     .rays = 8000,
                                     .bounds = false};
    for (const StressRow& row : rows_of(options)) {
        CAPTURE(row.family, language::word_of(row.precision), row.mode, row.isa);
        CHECK(row.second_rays > 1000);
        CHECK(row.self_hits == 0);
        CHECK(row.second_lost == 0);
        if (row.held)
            CHECK(row.second_inexact == 0);
    }
}

TEST_CASE("no family finds a fault in exact mode and in packets of doubles", "[stress]")
{
    for (const Traversal traversal : {Traversal::list, Traversal::tree}) {
        check_faultless({.traversal = traversal, .rays = 128});
    }
}

TEST_CASE("no family finds a fault in a quarter of a million rays", "[stress][slow]")
{
    check_faultless({.rays = 4096, .seed = 5});
}

TEST_CASE("packets are right outside the band of their own precision", "[stress]")
{
    lab::StressOptions options{.kernels = {"packet"}, .rays = 400, .bounds = false};
    for (const auto& some : {lab::sphere_families(), lab::plane_families(), lab::quadric_families(),
                             lab::scene_families()})
        for (const lab::StressFamily& family : some)
            options.families.push_back(family.name);
    for (const StressRow& row : rows_of(options)) {
        CAPTURE(row.family, language::word_of(row.precision), row.mode, row.isa, row.example);
        CHECK(row.beyond_own_band == 0);
        CHECK(row.not_finite == 0);
        CHECK(row.rho <= 4.0);
        CHECK(row.self_hits == 0);
        CHECK(row.second_lost == 0);
    }
}

TEST_CASE("powers, glass and mirrors keep their bounds", "[stress]")
{
    const lab::StressOptions options{.families = {"exponents", "exponent-1", "exponent-10000",
                                                  "critical-angle", "mirror-room", "mirror-ball"},
                                     .rays = 400};
    for (const StressRow& row : rows_of(options)) {
        CAPTURE(row.family, language::word_of(row.precision), row.mode, row.isa);
        CHECK(row.rays > 0);
        CHECK(row.beyond_own_band == 0);
        CHECK(row.faults.empty());
    }
}

TEST_CASE("the textbook test fails where packets hold", "[stress]")
{
    lab::StressOptions options{
        .families = {"tiny-far"}, .precisions = {Precision::single}, .rays = 1000};
    const auto far = rows_of(options);
    CHECK(row_of(far, "textbook", "").beyond_own_band > 100);
    CHECK(row_of(far, "packet", "fast").beyond_own_band == 0);
    options.families = {"ground-5000"};
    const auto ground = rows_of(options);
    CHECK(row_of(ground, "textbook", "").ulp.max > 1e4);
    CHECK(row_of(ground, "packet", "fast").ulp.max < 200.0);
    CHECK(row_of(ground, "packet", "exact").ulp.max < 4.0);
}

TEST_CASE("all instruction sets with fused multiply-add answer alike in every mode", "[stress]")
{
    const lab::StressOptions options{
        .kernels = {"packet"}, .rays = 300, .second_hits = false, .bounds = false};
    const std::vector<std::string> fused = {"sse_fma", "avx2", "avx512"};
    for (const StressRow& row : rows_of(options)) {
        CAPTURE(row.family, language::word_of(row.precision), row.mode, row.isa);
        // If any instruction set with fused multiply-add is listed, all of them are.
        const std::string names = " " + row.isa + " ";
        std::size_t in_row = 0;
        std::size_t supported = 0;
        for (const IsaInfo& isa : list_isas()) {
            if (!isa.supported || std::find(fused.begin(), fused.end(), isa.name) == fused.end())
                continue;
            ++supported;
            in_row += names.find(" " + isa.name + " ") != std::string::npos;
        }
        CHECK((in_row == 0 || in_row == supported));
    }
}

TEST_CASE("the stress command prints rows, a verdict, JSON and its families", "[stress]")
{
    const std::vector<std::string> few = {"stress", "--family", "plane", "--rays", "64"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), few.begin(), few.end());
        return run_packtrace(more);
    };
    const std::string exact = lab::stress_modes[std::size(lab::stress_modes) - 1].name;
    const ProgramResult table = with({"--kernel", "packet", "--mode", exact});
    CHECK(table.exit_code == 0);
    CHECK(table.out.find("plane") != std::string::npos);
    CHECK(table.out.find("verdict: " + exact + " is right in the family plane") !=
          std::string::npos);
    CHECK(table.out.find("fast") == std::string::npos);

    const auto json = nlohmann::json::parse(with({"--json", "--precision", "single"}).out);
    CHECK(json.at("rays_per_family") == 64);
    CHECK(json.at("verdict").get<std::string>().starts_with("verdict: "));
    CHECK(json.at("rows").size() >= 3);
    for (const auto& row : json.at("rows")) {
        CHECK(row.at("family") == "plane");
        CHECK(row.at("precision") == "single");
        CHECK(row.at("rays") == 64);
    }

    const ProgramResult list = run_packtrace({"stress", "--list"});
    CHECK(list.exit_code == 0);
    for (const auto& family : lab::list_stress_families())
        CHECK(list.out.find(family.name) != std::string::npos);
    CHECK(run_packtrace({"stress", "--rays", "0"}).exit_code == 2);
    CHECK(run_packtrace({"stress", "--mode", "nonsense"}).exit_code == 2);
    const ProgramResult doubles =
        run_packtrace({"stress", "--precision", "double", "--mode", "fast"});
    CHECK(doubles.exit_code == 2);
    CHECK_THAT(doubles.err, ContainsSubstring("--mode: only packets of floats have a choice"));
    CHECK(run_packtrace({"stress", "--self-hits", "nonsense"}).exit_code == 2);
}

TEST_CASE("the list of ray families refuses the options of a trace", "[stress]")
{
    const std::vector<std::vector<std::string>> refused{
        {"--rays", "10"},        {"--seed", "3"},       {"--kernel", "scalar"},
        {"--mode", "fast"},      {"--isa", "foo"},      {"--traversal", "list"},
        {"--threads", "2"},      {"--cases", "folder"}, {"--precision", "single"},
        {"--self-hits", "note"}, {"--shard", "0/3"}};
    for (const std::vector<std::string>& option : refused) {
        const ProgramResult result =
            run_packtrace({"stress", "--list", "--json", option[0], option[1]});
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        CHECK(result.err == "packtrace stress: " + option[0] +
                                ": --list traces no rays; leave one out; see packtrace stress "
                                "--help\n");
    }
    const ProgramResult one = run_packtrace({"stress", "--list", "--family", "plane", "--json"});
    CHECK(one.exit_code == 0);
    CHECK(nlohmann::json::parse(one.out).size() == 1);
}

TEST_CASE("the stress command suggests families similar to an unknown one, and how to list all",
          "[stress]")
{
    const auto fault_of = [](const std::string& family) {
        const ProgramResult result = run_packtrace({"stress", "--family", family});
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        return result.err;
    };
    const std::string start = "packtrace stress: --family: ";
    const std::string unknown = " is not a family that --list names; ";
    CHECK(fault_of("nonsense") == start + "'nonsense'" + unknown + "see packtrace stress --help\n");
    CHECK(fault_of("plnae") ==
          start + "'plnae'" + unknown + "did you mean plane? See packtrace stress --help\n");
    CHECK(fault_of("cone") == start + "'cone'" + unknown +
                                  "did you mean cone-apex, cone-side or cone-generators? See "
                                  "packtrace stress --help\n");
    CHECK(fault_of("e") == start + "'e'" + unknown + "see packtrace stress --help\n");
}

TEST_CASE("the stress command writes wrong rays and their scenes", "[stress]")
{
    const TempFolder folder;
    const auto run = [&](const std::string& into) {
        return run_packtrace({"stress", "--family", "tiny-far", "--rays", "64", "--kernel",
                              "textbook", "--precision", "single", "--cases", into});
    };
    CHECK(run((folder / ".").string()).exit_code == 0);
    const std::string name = (folder / "tiny-far-single-textbook").string();
    const ProgramResult traced = run_packtrace({"intersect", name + ".scene", name + ".csv"});
    CHECK(traced.exit_code == 0);
    CHECK(std::count(traced.out.begin(), traced.out.end(), '\n') == 2);
    // The folder is created for wrong rays; if a file is in its way, nothing is traced.
    const ProgramResult right =
        run_packtrace({"stress", "--family", "tiny-far", "--rays", "64", "--kernel", "packet",
                       "--mode", "exact", "--cases", (folder / "none").string()});
    CHECK(right.exit_code == 0);
    CHECK_FALSE(std::filesystem::exists(folder / "none"));
    CHECK(run((folder / "new").string()).exit_code == 0);
    CHECK(std::filesystem::exists(folder / "new" / "tiny-far-single-textbook.csv"));
    const ProgramResult nowhere = run(name + ".csv");
    CHECK(nowhere.exit_code != 0);
    CHECK(nowhere.out.empty());
    CHECK(nowhere.err.find(name + ".csv") != std::string::npos);
}

TEST_CASE("an interrupted stress test reports how far it came", "[stress]")
{
    const std::string families = std::to_string(lab::list_stress_families().size());
    CHECK_THAT(interrupted_message("stress"),
               ContainsSubstring("packtrace: interrupted after ") &&
                   ContainsSubstring(" of " + families + " families, 0 of ") &&
                   ContainsSubstring(" rows with faults"));
}

TEST_CASE("accuracy is refused where it has no meaning", "[stress]")
{
    const std::string scene = PACKTRACE_SOURCE_DIR "/scenes/four_spheres.scene";
    const auto render_with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"render", scene, "-o", "/nowhere/x.png"});
        return run_packtrace(more);
    };
    const ProgramResult scalar = render_with({"--kernel", "scalar", "--accuracy", "exact"});
    CHECK(scalar.exit_code == 2);
    CHECK(scalar.err.find("--accuracy") != std::string::npos);
    const ProgramResult doubles = render_with({"--precision", "double", "--accuracy", "fast"});
    CHECK(doubles.exit_code == 2);
}

}  // namespace packtrace::test
