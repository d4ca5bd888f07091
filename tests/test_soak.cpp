// Random scenes traced in every way, and the processing of findings.
#include "catch.hpp"
#include "killed_program.hpp"
#include "lab/soak/soak.hpp"
#include "lab/soak/soak_scene.hpp"
#include "lab/soak/soak_way.hpp"
#include "lab/stress/evaluate.hpp"
#include "lab/stress/stress_family.hpp"
#include "run_program.hpp"
#include "temp_folder.hpp"
#include <packtrace/read_scene.hpp>

#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <cmath>
#include <filesystem>

namespace packtrace::test {
namespace {

constexpr double roundoff_of_floats = 0x1p-24;

/// The faults of exact packets of floats on these rays, in all ways of tracing. For each way, only
/// the fault of the first wrong ray.
std::string faults_in_all_ways(const Scene& scene, const std::vector<lab::StressRay>& rays)
{
    lab::StressGroup group = lab::stress_group(scene);
    group.rays = rays;
    for (const lab::StressRay& ray : rays)
        group.expected.push_back(lab::expect(ray, group.hits_of(ray), roundoff_of_floats));
    std::string faults;
    for (const lab::SoakGroup& ways :
         lab::packet_groups(Precision::single, Accuracy::exact, SelfHits::exact))
        for (const lab::SoakWay& way : ways.ways) {
            const lab::StressRun run =
                lab::run_subject<float>({"packet", "", way.options.isa, true, way.options}, group);
            const char* fault = "";
            for (std::size_t i = 0; i < rays.size() && *fault == '\0'; ++i) {
                lab::Evaluation evaluation(roundoff_of_floats);
                lab::evaluate_ray(evaluation, group, run, i);
                fault = lab::fault_of(evaluation.errors());
            }
            if (*fault != '\0')
                faults += fault + lab::intersect_words(way) + "\n";
        }
    return faults;
}

}  // namespace

TEST_CASE("random scenes give correct answers in every way of tracing", "[soak]")
{
    // Some pictures are rendered by three threads, even if the machine has fewer.
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 3);
    const lab::SoakOptions options{.scenes = 64};
    std::string findings;
    const lab::SoakCounts counts = lab::run_soak(options, [&](const lab::SoakReport& report) {
        findings += std::to_string(report.number) + ": " + report.finding.what + "\n";
    });
    CHECK(findings == "");
    CHECK(counts.findings == 0);
    CHECK(counts.scenes == 64);
    CHECK(counts.refused <= 16);
}

TEST_CASE("scenes of earlier findings have no faults", "[soak]")
{
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 3);
    struct Earlier {
        std::uint64_t seed;
        std::uint64_t number;
        bool aligned = false;
    };
    for (const auto& [seed, number, aligned] : {
             Earlier{9001, 533},    // a cap of a quadric whose centre is far away
             Earlier{9001, 2565},   // a light closer than where the note's shadow rays start
             Earlier{4242, 434},    // a sphere and a direction of length 1e-9
             Earlier{4242, 2686},   // as 533
             Earlier{4242, 12485},  // as 2565
             Earlier{4242, 13446},  // a ray that runs nearly along a saddle and starts next to it
             Earlier{4242, 28648},  // a hit near a long hyperboloid's side, far from its centre
             Earlier{4242, 29921},  // as 28648
             Earlier{4242, 44944},  // a checker too fine for single precision, far away
             Earlier{4242, 16800},  // an eye inside an open quadric of glass and inside more glass
             Earlier{4242, 17416},  // as 16800
             Earlier{4242, 18344},  // a ray in the plane of a polygon
             Earlier{4242, 83511},  // directional light along a plane
             Earlier{4242, 10989},  // `fast` invents a second hit below its resolution
             Earlier{7777, 6354},   // a light near two intersecting planes, on neither
             Earlier{7778, 23308, true},  // twins at 0 and -0
         }) {
        lab::SoakOptions options{.seed = seed, .first = number, .scenes = 1};
        options.aligned = aligned;
        std::string findings;
        (void)lab::run_soak(
            options, [&](const lab::SoakReport& report) { findings += report.finding.what; });
        CAPTURE(seed, number);
        CHECK(findings == "");
    }
}

TEST_CASE("scenes of a soak depend only on seed and number", "[soak]")
{
    lab::StressRandom first(7);
    lab::StressRandom second(7);
    const Scene a = lab::soak_scene(first);
    const Scene b = lab::soak_scene(second);
    CHECK(a.objects.size() == b.objects.size());
    CHECK(a.camera.position == b.camera.position);
    CHECK(first.bits() == second.bits());
}

TEST_CASE("a finding is reduced to the objects that show it", "[soak]")
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

TEST_CASE("a cap of a general quadric is as exact as the digits that its far centre leaves",
          "[soak]")
{
    // The centre is about 1700 away, and the ray starts next to the cap.
    const Scene scene = parse_scene(R"(
        quadric {
            coefficients = (0, 0.1198276708987609, -1.1635582243516271, 0, 0.022780222910548265,
                            -0.26567375964139783, -0.34460821483340087, 0, 0, 0)
            z_range = (-1.5698657769184665, -0.7827591831370165)  capped = yes
            matrix = (0.1402977555990219, -0.20044903457164764, -0.4338940382003784,
                      -1.1306674480438232, -0.3427528738975525, 0.40099406242370605,
                      -0.29251033067703247, 0.18083029985427856, 0.4772816002368927,
                      0.37555044889450073, 0.10683446377515793, -2.5611259937286377)
        }
    )",
                                    "cap", {});
    CHECK(faults_in_all_ways(scene,
                             {{{-0.20631228387355804, -0.84449964761734009, -2.7321031093597412},
                               {-0.38771051168441772, -0.26925483345985413, 2.8319318294525146},
                               0.0,
                               lab::no_end}}) == "");
}

TEST_CASE("a hit on a long hyperboloid keeps its digits far from the centre", "[soak]")
{
    // The centre is 600000 away, and the ray's closest point to it is at t = -10⁷.
    const Scene near = parse_scene(R"(
        quadric {
            coefficients = (0, 0, 0.20916609758149107, 0.0037555573918224283, 1.7440348060678352, 0,
                            -0.15420128287996127, 1.1916414404481963, 0.8337514017737284,
                            -1.5565156119400796)
        }
    )",
                                   "near", {});
    CHECK(faults_in_all_ways(near,
                             {{{0.004255340900272131, 0.051672577857971191, 0.14732857048511505},
                               {-0.01663760282099247, 0.027004577219486237, -0.023907508701086044},
                               0.0,
                               lab::no_end}}) == "");
    // The same quadric, placed by a matrix.
    const Scene placed = parse_scene(R"(
        quadric {
            coefficients = (1.2057151840844114, 0, 0.11140713487581122, 0, -1.6491139787348126,
                            0.002684399726291975, 1.9674865503337506, -1.1747519113827782,
                            -1.8333710460462616, 0)
            matrix = (14600, -879, 1050, 30900, 178, 5500, 650, -1920, -1240, -606, 5550, -916)
        }
    )",
                                     "placed", {});
    CHECK(faults_in_all_ways(placed, {{{16597.916015625, -666.66650390625, 16574.921875},
                                       {28078.5859375, 33508.734375, 13071.90625},
                                       0.0,
                                       lab::no_end}}) == "");
}

TEST_CASE("quadrics whose centres are far away are hit where their equations say", "[soak]")
{
    lab::StressRandom random(28648);
    for (int i = 0; i < 40; ++i) {
        const double s = random.sign() * random.power(0.1, 2.0);
        Quadric quadric;
        quadric.coefficients = {s,
                                random.sign() * random.power(1e-7, 1e-5),
                                -s * random.power(0.3, 3.0),
                                random.sign() * random.power(1e-5, 1e-3),
                                random.between(-1.0, 1.0),
                                0.0,
                                random.between(-1.0, 1.0),
                                random.sign() * random.power(0.1, 1.0),
                                random.between(-1.0, 1.0),
                                random.between(-1.0, 1.0)};
        Scene scene;
        scene.objects.resize(1);
        scene.objects[0].surface = quadric;
        lab::round_to_precision<float>(scene);
        std::vector<lab::StressRay> rays;
        for (int ray = 0; ray < 100; ++ray) {
            lab::StressRay next = lab::ray_towards(random.box(1.0), random.box(1.0));
            lab::round_to_precision<float>(next);
            rays.push_back(next);
        }
        CAPTURE(i);
        CHECK(faults_in_all_ways(scene, rays) == "");
    }
}

TEST_CASE("the smallest spheres are hit by rays of the shortest directions", "[soak]")
{
    lab::StressRandom random(434);
    for (int i = 0; i < 20; ++i) {
        const double radius = random.power(1.1e-9, 1e-7);
        Scene scene{.objects = {lab::sphere_object(1e-5 * random.unit(), radius)}};
        lab::round_to_precision<float>(scene);
        const Vec3 center = std::get<Sphere>(scene.objects[0].surface).center;
        std::vector<lab::StressRay> rays;
        for (int ray = 0; ray < 100; ++ray) {
            const Vec3 org = center + radius * random.between(0.0, 4.0) * random.unit();
            const Vec3 aim = center + radius * random.between(0.0, 1.1) * random.unit();
            lab::StressRay next = lab::ray_towards(org, aim);
            next.dir = random.power(1.1e-9, 1e-6) * glm::normalize(next.dir);
            lab::round_to_precision<float>(next);
            rays.push_back(next);
        }
        CAPTURE(i, radius);
        CHECK(faults_in_all_ways(scene, rays) == "");
    }
}

TEST_CASE("normals of spheres seen from far away have unit length", "[soak]")
{
    lab::StressRandom random(21);
    // A sphere off the world's origin, and an anchored one.
    for (const double distance : {2.0, 1.0}) {
        const double radius = random.power(0.1, 1.0);
        const double angle = random.between(0.0, 6.0);
        const Vec3 center =
            radius * distance * Vec3(0.2, 0.98 * std::cos(angle), 0.98 * std::sin(angle));
        Scene scene{.objects = {lab::sphere_object(center, radius)}};
        lab::round_to_precision<float>(scene);
        lab::StressGroup group = lab::stress_group(scene);
        for (int i = 0; i < 200; ++i) {
            // At t = 1 the ray is at x = 0, inside the sphere: org and dir are rounded alike.
            const double x = random.power(1e6, 1e13);
            const double turn = random.between(0.0, 6.0);
            const double off = radius * random.between(0.0, 0.8);
            lab::StressRay ray{.org = {x, random.between(-4.0, 4.0), random.between(-4.0, 4.0)}};
            ray.dir = {-x, center.y + off * std::cos(turn) - ray.org.y,
                       center.z + off * std::sin(turn) - ray.org.z};
            ray.t_min = 0.0;
            ray.t_max = lab::no_end;
            lab::round_to_precision<float>(ray);
            group.expected.push_back(lab::expect(ray, group.hits_of(ray), roundoff_of_floats));
            group.rays.push_back(ray);
        }
        for (const lab::SoakGroup& ways :
             lab::packet_groups(Precision::single, Accuracy::exact, SelfHits::exact))
            for (const lab::SoakWay& way : ways.ways) {
                const lab::StressRun run = lab::run_subject<float>(
                    {"packet", "", way.options.isa, true, way.options}, group);
                lab::Evaluation evaluation(roundoff_of_floats);
                for (std::size_t i = 0; i < group.rays.size(); ++i)
                    lab::evaluate_ray(evaluation, group, run, i);
                const lab::Errors errors = evaluation.errors();
                CAPTURE(distance, lab::intersect_words(way));
                CHECK(errors.hits == 200);
                CHECK(errors.undecided < 20);
                CHECK(errors.wrong() + errors.not_finite == 0);
                CHECK(errors.no_normal == 0);
            }
    }
}

TEST_CASE("soak checks the scenes of a file, and random ones", "[soak]")
{
    const ProgramResult file = run_packtrace({"soak", four_spheres_file});
    CHECK(file.exit_code == 0);
    CHECK_THAT(file.out, ContainsSubstring("as it should be"));
    const TempFolder folder;
    write_text(folder / "empty.scene", "background = (1, 0, 0)\n");
    const ProgramResult empty = run_packtrace({"soak", folder / "empty.scene"});
    CHECK(empty.exit_code == 0);
    CHECK_THAT(empty.out, ContainsSubstring("as it should be"));
    const ProgramResult few = run_packtrace({"soak", "--scenes", "2", "--seed", "5"});
    CHECK(few.exit_code == 0);
    CHECK_THAT(few.out, ContainsSubstring("2 scenes") && ContainsSubstring("0 findings"));
    CHECK(run_packtrace({"soak", "--scenes", "0"}).exit_code == 2);
    const ProgramResult missing = run_packtrace({"soak", four_spheres_file, folder / "no.scene"});
    CHECK(missing.exit_code == 1);
    CHECK(missing.out.empty());
    CHECK(run_packtrace({"soak", "--minutes", "nan"}).exit_code == 2);
}

TEST_CASE("an interrupted soak reports how far it came", "[soak]")
{
    CHECK_THAT(interrupted_message("soak"),
               ContainsSubstring("interrupted after ") && ContainsSubstring("0 findings"));
}

TEST_CASE("a soak creates its folder of cases only for findings", "[soak]")
{
    const TempFolder folder;
    const auto soak = [&](const std::string& cases) {
        return run_packtrace({"soak", "--scenes", "1", "--seed", "5", "--cases", folder / cases});
    };
    CHECK(soak("new/cases/").exit_code == 0);
    CHECK(folder.names().empty());
    // If the folder can't be created, nothing is traced.
    write_text(folder / "file", "");
    const ProgramResult refused = soak("file/cases");
    CHECK(refused.exit_code == 1);
    CHECK(refused.out.empty());
    CHECK_THAT(refused.err, ContainsSubstring("can't make this folder"));
    CHECK((folder.names() == std::vector<std::string>{"file"}));
}

}  // namespace packtrace::test
