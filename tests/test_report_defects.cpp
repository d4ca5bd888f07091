// A report names the defect of faulty kernels.
#include "catch.hpp"
#include "dispatch/kernels.hpp"
#include "lab/report/report_study.hpp"
#include "lab/report/report_text.hpp"
#include "render_scene.hpp"
#include "scenes.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/report.hpp>

namespace packtrace::planted {
[[nodiscard]] const abi::KernelTable& kernel_table();
}

namespace packtrace::test {
namespace {

Variant variant_named(const std::string& name, const Scene& scene)
{
    return {.name = name, .isa = choose_isa().name, .depth = scene.max_depth};
}

/// The report of correct kernels beside those with a defect.
StudyReport report_beside(const Scene& scene, const Subject& defect)
{
    const ReportOptions options{.repetitions = 1};
    const std::string isa = choose_isa().name;
    const std::vector<Subject> subjects{
        packet_subject<float>(scene, lower(scene), kernels_of(isa), variant_named("sound", scene)),
        defect};
    return run_study(scene, Study::arithmetic, find_truth(scene, {}), subjects, options);
}

/// Correct kernels on a scene that was lowered wrongly.
template <class Change>
Subject wrongly_lowered(const Scene& scene, const Change& change,
                        SelfHits self_hits = default_self_hits)
{
    LoweredScene lowered = lower(scene, Accuracy::exact, self_hits);
    change(lowered);
    const auto& table = kernels_of(choose_isa().name);
    return packet_subject<float>(scene, lowered, table, variant_named("defect", scene));
}

/// Checks that one class dominates the defect's errors, and that the written report names this
/// class.
void check_named(const StudyReport& report, const std::string& kind)
{
    const ReportRun& sound = report.runs[0];
    const ReportRun& defect = report.runs[1];
    CAPTURE(kind, shares_text(sound), shares_text(defect), sound.error.pixels_off,
            defect.error.pixels_off);
    CHECK(sound.error.pixels_off <= 3);
    REQUIRE(defect.error.pixels_off >= 10);
    REQUIRE_FALSE(defect.shares.empty());
    CHECK(defect.looked_at_off);
    CHECK(defect.shares.front().kind == kind);
    CHECK(2 * defect.shares.front().pixels > defect.looked_at);

    SceneReport scene;
    scene.name = "four_spheres";
    scene.studies.push_back(report);
    const std::string text = report_markdown({scene}, {}, {});
    const std::size_t row = text.find("defect");
    REQUIRE(row != std::string::npos);
    CHECK_THAT(text.substr(row, text.find('\n', row) - row), ContainsSubstring(kind));
    CHECK_THAT(text, ContainsSubstring("*" + kind + "*: "));
}

}  // namespace

TEST_CASE("an epsilon that is too small is identified", "[report_defects]")
{
    const Scene scene = four_spheres(192, 192);
    const Subject defect = wrongly_lowered(
        scene, [](LoweredScene& s) { s.epsilon = 1e-9; }, SelfHits::note);
    check_named(report_beside(scene, defect), "near start");
}

TEST_CASE("an epsilon that is too large is identified", "[report_defects]")
{
    const Scene scene = four_spheres(192, 192);
    const Subject defect = wrongly_lowered(
        scene, [](LoweredScene& s) { s.epsilon = 0.05; }, SelfHits::note);
    check_named(report_beside(scene, defect), "near start");
}

TEST_CASE("a highlight's exponent that is off by one is identified", "[report_defects]")
{
    const Scene scene = four_spheres(192, 192);
    const Subject defect = wrongly_lowered(scene, [](LoweredScene& s) {
        for (LoweredMaterial& material : s.materials)
            material.shininess += 1.0;
    });
    check_named(report_beside(scene, defect), "highlight");
}

TEST_CASE("a culling defect that loses one ray in ten thousand is identified", "[report_defects]")
{
    const Scene scene = four_spheres(384, 384);
    const Subject defect = packet_subject<float>(scene, lower(scene), planted::kernel_table(),
                                                 variant_named("defect", scene));
    const StudyReport report = report_beside(scene, defect);
    check_named(report, "lost hit");
    // One in ten thousand of the camera rays and of the mirrored rays, which are about equally
    // many.
    CHECK(report.runs[1].error.pixels_off <= 2 * report.runs[1].error.pixels / 5000);
}

TEST_CASE("a depth limit that is too low is identified", "[report_defects]")
{
    const Scene scene = four_spheres(192, 192);
    const Subject defect = wrongly_lowered(scene, [](LoweredScene& s) { s.max_depth = 1; });
    check_named(report_beside(scene, defect), "deep");
}

TEST_CASE("errors of sampling are where the ray trees of a pixel's samples differ",
          "[report_defects]")
{
    ReportScene scene{"four spheres", four_spheres(96, 96)};
    const ReportOptions options{.isas = {choose_isa().name},
                                .samples = {1},
                                .adaptive = {},
                                .repetitions = 1,
                                .truth_samples = 64};
    const SceneReport whole = report(scene, options);
    const ReportRun& once = whole.studies.back().runs.front();
    REQUIRE(once.variant.samples == 1);
    REQUIRE(once.error.pixels_off > 100);
    int edges = 0;
    for (const ErrorShare& share : once.shares)
        if (share.kind == "silhouette" || share.kind == "shadow edge" || share.kind == "deep")
            edges += share.pixels;
    CAPTURE(shares_text(once));
    CHECK(5 * edges > 4 * once.looked_at);
}

}  // namespace packtrace::test
