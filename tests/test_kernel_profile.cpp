// Measurements inside the kernels: stages, rays, lanes, tests.
#include "catch.hpp"
#include "dispatch/kernels.hpp"
#include "lab/profile/observed_frame.hpp"
#include "lab/profile/profile_steps.hpp"
#include "lab/profile/stage_times.hpp"
#include "lab/profile/work_rows.hpp"
#include "render_scene.hpp"
#include "run_program.hpp"
#include "scenes.hpp"
#include <packtrace/compare.hpp>
#include <packtrace/isa.hpp>
#include <packtrace/profile.hpp>
#include <packtrace/read_scene.hpp>

#include <algorithm>
#include <limits>

namespace packtrace::test {
namespace {

// The measurements that are recorded of a frame.
struct Records {
    std::vector<abi::StageTicks> stages;
    std::vector<abi::StepTicks> steps;
    std::vector<abi::WorkCounts> counts;

    explicit Records(const Scene& scene)
        : stages(static_cast<std::size_t>(scene.max_depth) + 1),
          steps(stages.size()),
          counts(stages.size())
    {
    }
    [[nodiscard]] abi::Observation into() const
    {
        return {.generations = static_cast<int>(stages.size())};
    }
};

template <class Real>
FrameCounts observe(ObservedFrame<Real>& frame, abi::Observation& observation)
{
    return frame.render([&](int) { return &observation; }, [](int, double) {});
}

template <class Real>
ObservedFrame<Real> observed_frame(const Scene& scene, const std::string& isa,
                                   const RenderOptions& options = {})
{
    return {scene, observable(lower(scene, accuracy_in<Real>(options))), kernels_of(isa), options};
}

// A frame's counts, with its rays.
struct Counted {
    std::vector<abi::WorkCounts> counts;
    FrameCounts rays;
    int lanes = 0;
};

template <class Real>
Counted counted(const Scene& scene, const std::string& isa, const RenderOptions& options = {})
{
    Records records(scene);
    abi::Observation observation = records.into();
    observation.counts = records.counts.data();
    auto frame = observed_frame<Real>(scene, isa, options);
    const FrameCounts rays = observe(frame, observation);
    return {records.counts, rays, precision<Real>(kernels_of(isa)).lanes};
}

const abi::PacketCounts& packets_of(const abi::WorkCounts& counts, abi::PacketWork work)
{
    return counts.work[static_cast<int>(work)];
}

std::uint64_t all_pairs(const abi::WorkCounts& counts, abi::RayPurpose purpose)
{
    std::uint64_t sum = 0;
    for (const abi::TestCounts& tests : counts.tests[static_cast<int>(purpose)])
        sum += tests.pairs;
    return sum;
}

std::uint64_t all_nodes(const abi::WorkCounts& counts)
{
    std::uint64_t sum = 0;
    for (int purpose = 0; purpose < abi::purpose_count; ++purpose)
        sum += counts.group_nodes[purpose] + counts.ray_nodes[purpose];
    return sum;
}

Scene sized(Scene scene, int width, int height)
{
    set_size(scene, width, height);
    return scene;
}

Scene scene_file(const std::string& name, int width = 50, int height = 35)
{
    return sized(read_scene(PACKTRACE_SOURCE_DIR "/scenes/" + name + ".scene"), width, height);
}

// Scenes with lists and with a bvh, with mirrors, glass, quadrics and transparent shadows.
std::vector<Scene> all_sorts()
{
    Scene many = random_spheres(150, 7);
    many.max_depth = 3;
    // Each pixel of nested glass has thousands of rays: with a sixth of the pixels it still has
    // more rays than the other scenes.
    return {four_spheres(50, 35), many, scene_file("quadrics"), scene_file("nested_glass", 21, 15),
            scene_file("transparent_shadows")};
}

template <class Real>
Image<Real> picture_of(const Scene& scene, const std::string& isa, bool general)
{
    const RenderOptions options{.force_general = general};
    const LoweredScene lowered = lower(scene, accuracy_in<Real>(options));
    ObservedFrame<Real> frame(scene, lowered, kernels_of(isa), options);
    frame.render([](int) { return nullptr; }, [](int, double) {});
    return frame.image();
}

template <class Real>
void check_pictures(const Scene& scene, const std::string& isa)
{
    const Image<Real> own = picture_of<Real>(scene, isa, false);
    const Image<Real> plain = picture_of<Real>(scene, isa, true);
    CAPTURE(isa, scene.objects.size(), sizeof(Real));
    CHECK((own.rgb == plain.rgb));
    auto frame = observed_frame<Real>(scene, isa);
    const auto check = [&](abi::Observation* observation) {
        frame.render([&](int) { return observation; }, [](int, double) {});
        CHECK((frame.image().rgb == plain.rgb));
    };
    check(nullptr);
    Records records(scene);
    abi::Observation observation = records.into();
    observation.stages = records.stages.data();
    check(&observation);
    observation.stages = nullptr;
    observation.steps = records.steps.data();
    check(&observation);
    observation.counts = records.counts.data();
    check(&observation);
}

template <class Real>
void check_rays(const Scene& scene, const std::string& isa, const RenderOptions& options = {})
{
    const Counted frame = counted<Real>(scene, isa, options);
    FrameCounts sum;
    for (std::size_t depth = 0; depth < frame.counts.size(); ++depth) {
        const abi::WorkCounts& at = frame.counts[depth];
        const std::uint64_t traced = packets_of(at, abi::PacketWork::trace).live;
        (depth == 0 ? sum.camera : sum.reflected) += traced + at.untraced - at.refracted;
        sum.refracted += at.refracted;
        sum.shadow += packets_of(at, abi::PacketWork::shadow).live;
        CHECK((depth == 0 || at.untraced == 0));
        if (depth > 0)
            CHECK(traced == packets_of(frame.counts[depth - 1], abi::PacketWork::children).live);
    }
    CHECK(sum.camera == frame.rays.camera);
    CHECK(sum.shadow == frame.rays.shadow);
    CHECK(sum.reflected == frame.rays.reflected);
    CHECK(sum.refracted == frame.rays.refracted);
}

abi::StepTicks ticks_of(abi::Stage stage, abi::RayPurpose purpose, abi::Step step,
                        const abi::Ticks& step_ticks)
{
    abi::StepTicks ticks;
    ticks.step[static_cast<int>(stage)][static_cast<int>(purpose)][static_cast<int>(step)] =
        step_ticks;
    return ticks;
}

double seconds_of(const std::vector<KernelStage>& stages, const std::string& rays,
                  const std::string& name)
{
    for (const KernelStage& stage : stages)
        if (stage.rays == rays && stage.name == name)
            return stage.seconds;
    return 0.0;
}

}  // namespace

TEST_CASE("recording changes no bit of a picture", "[kernel_profile]")
{
    for (const std::string& isa : supported_isas())
        for (const Scene& scene : all_sorts()) {
            check_pictures<float>(scene, isa);
            check_pictures<double>(scene, isa);
        }
}

TEST_CASE("the rays counted by generation are those of the frame, each counted once",
          "[kernel_profile]")
{
    for (const std::string& isa : supported_isas())
        for (const Scene& scene : all_sorts()) {
            CAPTURE(isa);
            check_rays<float>(scene, isa);
            check_rays<double>(scene, isa);
        }
    RenderOptions several{.samples = 3};
    check_rays<float>(four_spheres(50, 35), supported_isas().back(), several);
    several.adaptive = 0.05;
    check_rays<float>(four_spheres(50, 35), supported_isas().back(), several);
}

TEST_CASE("reflected rays are tested at most once against each object of a list",
          "[kernel_profile]")
{
    const Scene scene = four_spheres(50, 35);
    for (const std::string& isa : supported_isas())
        for (const Accuracy accuracy : {Accuracy::fast, Accuracy::exact}) {
            const Counted frame = counted<float>(scene, isa, {.accuracy = accuracy});
            for (int depth = 1; depth <= scene.max_depth; ++depth) {
                CAPTURE(isa, static_cast<int>(accuracy), depth);
                const abi::WorkCounts& at = frame.counts[static_cast<std::size_t>(depth)];
                const std::uint64_t live = packets_of(at, abi::PacketWork::trace).live;
                const std::uint64_t hits = packets_of(at, abi::PacketWork::shade).live;
                REQUIRE(live > 0);
                const std::uint64_t pairs = all_pairs(at, abi::RayPurpose::own);
                // Rays that single precision is unsure of are tested again in double, against all
                // objects.
                const std::uint64_t again = accuracy == Accuracy::exact ? live / 100 + 2 : 0;
                CHECK(pairs <= 4 * (live + again));
                // Culling saves tests, but each hit needs one.
                CHECK(pairs >= hits);
            }
            CHECK(all_pairs(frame.counts[0], abi::RayPurpose::own) <= 4 * frame.rays.camera);
        }
}

TEST_CASE("rays are not tested against a body that all of a packet start on", "[kernel_profile]")
{
    Scene scene;
    set_size(scene, 32, 32);
    scene.max_depth = 1;
    add_plane(scene, {0, 0, 3}, {0, 0, -1}, scratch({1, 1, 1}, -1, 0.5));
    add_plane(scene, {0, 0, -5}, {0, 0, 1}, scratch({1, 1, 1}, -1, 0));
    for (const std::string& isa : supported_isas())
        for (const Accuracy accuracy : {Accuracy::fast, Accuracy::exact}) {
            CAPTURE(isa, static_cast<int>(accuracy));
            const RenderOptions options{.accuracy = accuracy};
            const abi::WorkCounts mirrored = counted<float>(scene, isa, options).counts[1];
            CHECK(packets_of(mirrored, abi::PacketWork::trace).live == 32u * 32u);
            CHECK(all_pairs(mirrored, abi::RayPurpose::own) == 32u * 32u);
        }
}

TEST_CASE("tests are counted by kind, and those of shadow rays separately", "[kernel_profile]")
{
    Scene scene;
    set_size(scene, 32, 32);
    add_plane(scene, {0, 0, 3}, {0, 0, -1}, scratch({1, 1, 1}, -1, 0));
    // Occludes the light, behind the camera.
    add_plane(scene, {0, 0, -5}, {0, 0, 1}, scratch({1, 1, 1}, -1, 0));
    scene.lights = {{LightType::directional, Rgb(1.0), {0, 0, -1}}};
    const Counted frame = counted<double>(scene, supported_isas().front());
    const abi::WorkCounts& at = frame.counts[0];
    for (int purpose = 0; purpose < abi::purpose_count; ++purpose)
        for (int kind = 0; kind < abi::primitive_count; ++kind)
            CHECK(at.tests[purpose][kind].pairs ==
                  (kind == static_cast<int>(abi::Primitive::plane) ? 32u * 32u : 0u));
    CHECK(frame.rays.shadow == 32u * 32u);
    CHECK(packets_of(at, abi::PacketWork::highlight).packets == 0);
    CHECK(packets_of(at, abi::PacketWork::children).packets == 0);
}

TEST_CASE("nodes are visited only in a bvh, which saves tests", "[kernel_profile]")
{
    const Scene scene = random_spheres(150, 7);
    const RenderOptions list{.traversal = Traversal::list};
    const RenderOptions tree{.traversal = Traversal::tree};
    for (const std::string& isa : supported_isas()) {
        const Counted in_list = counted<float>(scene, isa, list);
        const Counted in_tree = counted<float>(scene, isa, tree);
        for (std::size_t depth = 0; depth < in_tree.counts.size(); ++depth) {
            const abi::WorkCounts& at = in_tree.counts[depth];
            const abi::WorkCounts& without = in_list.counts[depth];
            CHECK(all_nodes(without) == 0);
            CHECK(all_nodes(at) > 0);
            CHECK(packets_of(at, abi::PacketWork::trace).live ==
                  packets_of(without, abi::PacketWork::trace).live);
            // Each hit needed a test; most other objects were not tested.
            CHECK(all_pairs(at, abi::RayPurpose::own) >=
                  packets_of(at, abi::PacketWork::shade).live);
            if (depth > 0)
                CHECK(4 * all_pairs(at, abi::RayPurpose::own) <
                      all_pairs(without, abi::RayPurpose::own));
        }
    }
}

TEST_CASE("cells without a ray are not tested against any object", "[kernel_profile]")
{
    // One tile, whose mirrored rays fill few cells of their bundle.
    Scene scene = sized(random_spheres(400, 7), 16, 16);
    for (Object& object : scene.objects)
        object.material = scratch({1, 1, 1}, -1, 0);
    add_sphere(scene, {0, 0, 2}, 0.3, scratch({1, 1, 1}, -1, 0.5));
    for (const std::string& isa : supported_isas()) {
        const Counted frame = counted<float>(scene, isa);
        REQUIRE(packets_of(frame.counts[1], abi::PacketWork::trace).live > 0);
        REQUIRE(packets_of(frame.counts[1], abi::PacketWork::trace).live < 64);
        for (const abi::WorkCounts& at : frame.counts)
            for (const auto& purpose : at.tests)
                for (const abi::TestCounts& tests : purpose) {
                    CAPTURE(isa, tests.packets, tests.pairs);
                    // A cell has up to four packets, some perhaps without a ray.
                    CHECK(tests.packets <= 4 * tests.pairs);
                }
    }
}

TEST_CASE("packets have live lanes, and coherent packets have only live lanes", "[kernel_profile]")
{
    for (const std::string& isa : supported_isas())
        for (const Scene& scene : all_sorts()) {
            const Counted frame = counted<float>(scene, isa);
            for (const LaneUse& row : lane_rows(frame.counts)) {
                CAPTURE(isa, row.work, row.depth);
                const auto lanes = static_cast<std::uint64_t>(frame.lanes);
                CHECK(row.packets > 0);
                CHECK(row.live >= row.packets);
                CHECK(row.live <= row.packets * lanes);
                CHECK(row.coherent.value_or(0) <= row.packets);
                CHECK(row.coherent.value_or(0) * lanes <= row.live);
                CHECK(row.coherent.has_value() ==
                      (row.work == "closest hits" || row.work == "shadow rays"));
            }
        }
}

TEST_CASE("packets that see one surface are coherent, and packets that see nothing are not traced",
          "[kernel_profile]")
{
    const std::string isa = supported_isas().back();
    Scene wall;
    set_size(wall, 64, 64);
    add_plane(wall, {0, 0, 3}, {0, 0, -1}, scratch({1, 1, 1}, -1, 0));
    const Counted facing = counted<float>(wall, isa);
    const abi::PacketCounts& traced = packets_of(facing.counts[0], abi::PacketWork::trace);
    CHECK(traced.packets == 64u * 64u / static_cast<unsigned>(facing.lanes));
    CHECK(traced.coherent == traced.packets);
    CHECK(lanes_filled(facing.counts[0], facing.lanes).value() == 1.0);

    Scene behind;
    set_size(behind, 64, 64);
    add_sphere(behind, {0, 0, -9}, 1, scratch({1, 1, 1}, -1, 0));
    const Counted empty = counted<float>(behind, isa);
    CHECK(empty.counts[0].untraced == 64u * 64u);
    CHECK(packets_of(empty.counts[0], abi::PacketWork::trace).packets == 0);
    CHECK_FALSE(lanes_filled(empty.counts[0], empty.lanes).has_value());
}

TEST_CASE("a stage's time is divided in proportion to its steps, over the rays that it had",
          "[kernel_profile]")
{
    GenerationTimes first;
    first.stage[static_cast<std::size_t>(abi::Stage::shade)] = 10.0;
    GenerationTimes second;
    second.stage[static_cast<std::size_t>(abi::Stage::trace)] = 8.0;
    second.refracted = 0.25;
    // 100 ticks minus two clock readings of 10, and 30 ticks minus one.
    abi::StepTicks shade =
        ticks_of(abi::Stage::shade, abi::RayPurpose::own, abi::Step::diffuse, {100, 2});
    shade.step[static_cast<int>(abi::Stage::shade)][static_cast<int>(abi::RayPurpose::shadow)]
              [static_cast<int>(abi::Step::spheres)] = {30, 1};
    // Fewer ticks than its clock readings take: divided without subtracting them.
    const abi::StepTicks trace =
        ticks_of(abi::Stage::trace, abi::RayPurpose::own, abi::Step::boxes, {5, 1});
    StageSeconds seconds(2);
    seconds.add({first, second}, {shade, trace}, 10);
    const std::vector<KernelStage> stages = seconds.stages();
    CHECK(stages.size() == 4);
    CHECK(seconds_of(stages, "hits", "diffuse light") == 8.0);
    CHECK(seconds_of(stages, "shadow", "spheres") == 2.0);
    CHECK(seconds_of(stages, "reflected", "traversal of boxes") == 6.0);
    CHECK(seconds_of(stages, "refracted", "traversal of boxes") == 2.0);
}

TEST_CASE("the time of a frame is the sum of its pieces' medians", "[kernel_profile]")
{
    PieceTimes times(2);
    for (const double seconds : {1.0, 50.0, 2.0})
        times.add(0, seconds);
    times.add(1, 10.0);
    CHECK(times.frame() == 12.0);
}

TEST_CASE("stages belong to existing rays", "[kernel_profile]")
{
    const std::string file = PACKTRACE_SOURCE_DIR "/scenes/nested_glass.scene";
    const ProfileOptions options{.repetitions = 3};
    const Profile result =
        profile<float>(read_text(file), sized(read_scene(file), 36, 24), options);
    const KernelProfile& kernels = result.kernels;
    CHECK(kernels.plain > 0.0);
    CHECK(kernels.clocked > 0.0);
    double sum = 0.0;
    for (const KernelStage& stage : kernels.stages) {
        CHECK(stage.seconds > 0.0);
        CHECK((stage.rays == "hits" ||
               std::any_of(kernels.rays.begin(), kernels.rays.end(), [&](const RayTime& row) {
                   return row.depth == stage.depth && row.rays == stage.rays;
               })));
        sum += stage.seconds;
    }
    // Only some of the stages find rays.
    double rays = 0.0;
    for (const RayTime& row : kernels.rays)
        rays += row.seconds;
    CHECK(rays > 0.0);
    CHECK(rays < sum);
}

TEST_CASE("tracing rays again in double is a stage, and these rays are counted by cause",
          "[kernel_profile]")
{
    // Two nearly equal balls: rounding decides which is hit first.
    Scene scene = four_spheres(48, 48);
    std::get<Sphere>(scene.objects[1].surface) = std::get<Sphere>(scene.objects[0].surface);
    std::get<Sphere>(scene.objects[1].surface).radius *= 1.0 + 1e-9;
    const ProfileOptions options{.repetitions = 2};
    const KernelProfile single = observe_kernels<float>(scene, options).profile;
    CHECK(std::any_of(single.stages.begin(), single.stages.end(), [](const KernelStage& stage) {
        return stage.name == "unsure rays again in double" && stage.rays == "camera";
    }));
    std::uint64_t camera = 0;
    for (const UnsureUse& row : single.unsure)
        camera += row.depth == 0 && row.rays == "closest" && row.cause == "order" ? row.count : 0;
    CHECK(camera > 50);
    const KernelProfile doubles = observe_kernels<double>(scene, options).profile;
    CHECK(doubles.unsure.empty());
    for (const KernelStage& stage : doubles.stages)
        CHECK(stage.name != "unsure rays again in double");
}

}  // namespace packtrace::test
