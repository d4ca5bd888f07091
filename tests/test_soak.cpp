// Random scenes in every way there is, and what is done with a finding.
#include "lab/soak/soak.hpp"

#include <packtrace/read_scene.hpp>

#include <tbb/global_control.h>

#include "catch.hpp"
#include "lab/soak/shrink.hpp"
#include "lab/soak/soak_scene.hpp"
#include "run_program.hpp"

namespace packtrace::test {

TEST_CASE("random scenes give the answers that are promised in every way", "[soak]")
{
    // Some pictures are made by three threads, also where the machine has fewer.
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 3);
    lab::SoakOptions options;
    options.scenes = 64;
    std::string findings;
    const lab::SoakCounts counts = lab::run_soak(options, [&](const lab::SoakReport& report) {
        findings += std::to_string(report.number) + ": " + report.finding.what + "\n";
    });
    CHECK(findings == "");
    CHECK(counts.findings == 0);
    CHECK(counts.scenes == 64);
    CHECK(counts.refused <= 16);
}

TEST_CASE("scenes of a soak follow from seed and number", "[soak]")
{
    lab::StressRandom first(7);
    lab::StressRandom second(7);
    const Scene a = lab::soak_scene(first);
    const Scene b = lab::soak_scene(second);
    CHECK(a.objects.size() == b.objects.size());
    CHECK(a.camera.position == b.camera.position);
    CHECK(first.bits() == second.bits());
}

TEST_CASE("a finding is shrunk to what shows it", "[soak]")
{
    const Scene scene = parse_scene(R"(
        illumination = general  max_depth = 5
        light { type = ambient intensity = 0.3 }
        light { type = point position = (1, 2, 3) intensity = 0.7 }
        sphere { center = (0, 0, 3) radius = 1 diffuse = 0.4 }
        sphere { center = (0.123456789, 1, 4) radius = 2 diffuse = 0.5 rotate = (1, 0, 0, 30) }
        plane { point = (0, -1, 0) normal = (0, 1, 0) diffuse = 0.5 }
    )",
                                    "soak", {});
    lab::SoakFinding finding;
    finding.again = [](const Scene& tried) -> std::string {
        for (const Object& object : tried.objects)
            if (const auto* const sphere = std::get_if<Sphere>(&object.surface))
                if (sphere->radius > 1.5)
                    return "large";
        return "";
    };
    const Scene small = lab::shrink(finding, scene);
    CHECK(finding.what == "large");
    REQUIRE(small.objects.size() == 1);
    CHECK(small.lights.empty());
    CHECK(small.max_depth == 0);
    CHECK(small.objects[0].transform == Mat4(1.0));
    CHECK(std::get<Sphere>(small.objects[0].surface).center.x == 0.123);
}

TEST_CASE("soak checks scenes of a file, and random ones", "[soak]")
{
    const ProgramResult file = run_packtrace({"soak", four_spheres_file});
    CHECK(file.exit_code == 0);
    CHECK_THAT(file.out, ContainsSubstring("as it should be"));
    const ProgramResult few = run_packtrace({"soak", "--scenes", "2", "--seed", "5"});
    CHECK(few.exit_code == 0);
    CHECK_THAT(few.out, ContainsSubstring("2 scenes") && ContainsSubstring("0 findings"));
    CHECK(run_packtrace({"soak", "--scenes", "0"}).exit_code == 2);
    CHECK(run_packtrace({"soak", "--minutes", "nan"}).exit_code == 2);
}

}  // namespace packtrace::test
