// Features that a scene does not need are skipped; its picture stays the same, bit for bit.
#include "catch.hpp"
#include "dispatch/kernels.hpp"
#include "feature_scenes.hpp"
#include "lower/packed_scene.hpp"
#include "lower/prune.hpp"
#include "render/tile_loop.hpp"
#include "render/tile_renderer.hpp"
#include "render_scene.hpp"
#include "same_bits.hpp"
#include <packtrace/build.hpp>
#include <packtrace/compare.hpp>
#include <packtrace/write_scene.hpp>

namespace packtrace::test {
namespace {

template <class Real>
Image<Real> render_general(const Scene& scene, const std::string& isa)
{
    return render<Real>(scene, {.isa = isa, .force_general = true});
}

/// The work of one thread for a whole picture, and its memory.
struct Work {
    abi::RayCounts counts;
    std::size_t bytes = 0;
};

Work work_of(const Scene& scene, bool force_general = false, Accuracy accuracy = Accuracy::exact)
{
    const abi::KernelTable& table = kernels_of(choose_isa().name);
    const RenderOptions options{.force_general = force_general};
    LoweredScene lowered = lower(scene, accuracy);
    const TileRenderer<float> tiles(scene, lowered, table, options);
    Image<float> image(scene.width, scene.height);
    Work work;
    work.bytes = tiles.scratch_bytes();
    const TileGrid grid({0, 0, scene.width, scene.height});
    for (int tile = 0; tile < grid.count(); ++tile)
        work.counts += tiles.render_once(image, grid[tile]);
    return work;
}

LoweredScene pruned(const Scene& scene)
{
    LoweredScene lowered = lower(scene);
    prune(lowered);
    return lowered;
}

abi::Features features_of(const Scene& scene)
{
    return pruned(scene).features;
}

/// The name of the narrowest kernel that renders a scene.
std::string kernel_of(const Scene& scene)
{
    const abi::Features needed = features_of(scene);
    for (const abi::FeatureSet& set : abi::feature_sets)
        if (abi::covers(abi::with_exact(set.features, needed.exact), needed))
            return set.name;
    return "none";
}

/// Whether an instruction set has compiled kernels for sets of features.
bool has_special_kernels(const std::string& isa)
{
    return kernels_for(precision<float>(kernels_of(isa)), {.exact = true}).set.name ==
           std::string("spheres");
}

Scene scene_named(const std::string& name)
{
    for (const NamedScene& named : feature_scenes())
        if (named.name == name)
            return named.scene;
    FAIL("no scene is named " + name);
    return {};
}

}  // namespace

TEMPLATE_TEST_CASE("special kernels and the general one give the same bits", "[features]", float,
                   double)
{
    std::vector<NamedScene> scenes = feature_scenes();
    scenes.push_back({"a forest", forest_scene()});
    for (NamedScene& named : packet_scenes())
        scenes.push_back(std::move(named));
    for (const NamedScene& named : scenes)
        for (const std::string& isa : supported_isas()) {
            CAPTURE(named.name, isa);
            CHECK(same_bits(render_packets<TestType>(named.scene, isa),
                            render_general<TestType>(named.scene, isa)));
        }
}

TEST_CASE("scenes that lack a feature look as in the reference", "[features][bulk]")
{
    std::vector<NamedScene> scenes = feature_scenes();
    scenes.push_back({"a forest", forest_scene()});
    for (const NamedScene& named : scenes) {
        CAPTURE(named.name);
        const Image<double> truth = render_scalar<double>(named.scene);
        CHECK(compare(render_packets<double>(named.scene, choose_isa().name), truth).max_abs <=
              1e-9);
    }
}

TEST_CASE("each scene gets the narrowest kernel", "[features]")
{
    for (const char* name : {"matt", "checkers", "mirrors at depth 0", "highlights", "mirrors"})
        CHECK(kernel_of(scene_named(name)) == "spheres");
    for (const char* name : {"quadrics", "tinted mirrors", "glass"})
        CHECK(kernel_of(scene_named(name)) == "general");
    CHECK_FALSE(pruned(scene_named("mirrors at depth 0")).bounces);
    // The depth limit has a colour, which transparent and mirroring surfaces show.
    CHECK(pruned(scene_named("glass at depth 0")).bounces);
}

TEST_CASE("kernels for sets of features run if they are compiled in", "[features]")
{
    for (const std::string& isa : supported_isas()) {
        const bool special =
            PACKTRACE_FEATURE_SETS && (isa == "avx2" || isa == "avx512" || isa == "neon64");
        CHECK(has_special_kernels(isa) == special);
        for (const char* name : {"checkers", "mirrors", "tinted mirrors", "glass"}) {
            const Scene scene = scene_named(name);
            const auto& kernels =
                kernels_for(precision<float>(kernels_of(isa)), features_of(scene));
            CAPTURE(isa, name);
            CHECK(kernels.set.name == (special ? kernel_of(scene) : "general"));
        }
    }
}

TEST_CASE("kernels skip the steps that a scene does not need", "[features]")
{
    const auto passed = [](const Scene& scene) { return work_of(scene).counts.passed; };
    const auto passed_by_fast = [](const Scene& scene) {
        return work_of(scene, false, Accuracy::fast).counts.passed;
    };
    // In exact mode hits are refined if anything but their object matters.
    const std::uint32_t shown = abi::passed_hits | abi::passed_normals;
    const std::uint32_t shaded = shown | abi::passed_occluders | abi::passed_shadow_rays;
    CHECK(passed(matt_scene()) == (shaded | abi::passed_refined));
    CHECK(passed_by_fast(matt_scene()) == shaded);
    CHECK(passed(scene_named("ambient light alone")) == abi::passed_hits);
    CHECK(passed(scene_named("ambient light on a quadric")) == abi::passed_hits);
    for (const char* name : {"no shadows", "no object with a shadow"}) {
        CHECK(passed(scene_named(name)) == (shown | abi::passed_refined));
        CHECK(passed_by_fast(scene_named(name)) == shown);
    }
    CHECK((passed(scene_named("highlights")) & abi::passed_powers) != 0);
    CHECK((passed(scene_named("mirrors")) & (abi::passed_powers | abi::passed_mirrored)) ==
          abi::passed_mirrored);
    CHECK((passed(scene_named("tinted mirrors")) & abi::passed_refracted) == 0);
    CHECK((passed(scene_named("glass")) & abi::passed_refracted) != 0);
    CHECK((passed(forest_scene()) & abi::passed_hierarchy) != 0);
    CHECK((passed(matt_scene()) & abi::passed_hierarchy) == 0);
}

TEST_CASE("rays that a scene does not need are not traced", "[features]")
{
    const abi::RayCounts none = work_of(scene_named("no object with a shadow")).counts;
    CHECK(none.camera == 80u * 60u);
    CHECK(none.shadow + none.reflected + none.refracted == 0);
    CHECK(work_of(scene_named("ambient light alone")).counts.shadow == 0);
    CHECK(work_of(scene_named("mirrors at depth 0")).counts.reflected == 0);

    // One of two lights casts no shadows.
    Scene scene = scene_named("a light that reaches everything");
    const std::uint64_t one = work_of(scene).counts.shadow;
    scene.lights[0].casts_shadow = true;
    CHECK(one > 0);
    CHECK(work_of(scene).counts.shadow > one);

    // A dark light does not count.
    CHECK(work_of(scene_named("a dark light and an object twice")).counts.shadow ==
          work_of(matt_scene()).counts.shadow);
}

TEST_CASE("features that a scene does not need take no memory", "[features]")
{
    if (!has_special_kernels(choose_isa().name))
        return;
    const Scene matt = matt_scene();
    const std::size_t special = work_of(matt).bytes;
    CHECK(special < work_of(matt, true).bytes / 3);
    Scene parallel = matt;
    parallel.lights = {directional_light({1, 2, -1}, Rgb(1.0))};
    Scene unshadowed = parallel;
    for (Object& object : unshadowed.objects)
        object.casts_shadow = false;
    CHECK(work_of(unshadowed).bytes < work_of(parallel).bytes);
    CHECK(work_of(scene_named("mirrors")).bytes > special);
    CHECK(work_of(scene_named("glass")).bytes > work_of(scene_named("mirrors")).bytes);
}

TEST_CASE("dark lights and coincident copies of objects are pruned", "[features]")
{
    LoweredScene lowered = lower(scene_named("a dark light and an object twice"));
    const std::vector<LeftOut> left_out = prune(lowered);
    REQUIRE(left_out.size() == 2);
    CHECK(left_out[0].what == "1 light");
    CHECK(left_out[1].what == "2 surfaces");
    CHECK(lowered.lights.size() == 1);
    REQUIRE(lowered.spheres.size() == 2);
    CHECK(lowered.spheres[1].surface == 1);

    // Where shadows are transparent, each object dims the light.
    lowered = lower(parse("illumination = general\nshadows = transparent\n" + one_light +
                          "sphere { center = (0, 0, 3) radius = 1 transmit = 0.5 }\n"
                          "sphere { center = (0, 0, 3) radius = 1 transmit = 0.5 }\n"));
    CHECK(prune(lowered).empty());
    CHECK(lowered.spheres.size() == 2);

    // An object that casts no shadow does not replace one that does.
    lowered = lower(parse(one_light + "sphere { center = (0, 0, 3) radius = 1 casts_shadow = no }\n"
                                      "sphere { center = (0, 0, 3) radius = 1 }\n"));
    CHECK(prune(lowered).empty());
}

TEST_CASE("a material without surfaces is pruned", "[features]")
{
    const std::string lit = "background = (9, 9, 9)\n" + one_light;
    const std::string mirror =
        "sphere { center = (0, 0, 3) radius = 1 reflective = 0.5 specular = 9 }";
    const LoweredScene shown = pruned(parse(lit + mirror));
    CHECK((shown.bounces && shown.highlights));
    const LoweredScene hidden =
        pruned(parse(lit + "sphere { center = (0, 0, 3) radius = 1 }\n" + mirror));
    CHECK_FALSE((hidden.bounces || hidden.highlights));
    CHECK(hidden.max_depth == 0);
}

TEST_CASE("casts_shadow is read and written back", "[features]")
{
    const std::string text =
        "sphere { center = (0, 0, 3) radius = 1 casts_shadow = no }\n"
        "light { type = point intensity = 1 position = (0, 9, 0) casts_shadow = no }\n";
    const Scene scene = parse(text);
    CHECK_FALSE(scene.objects[0].casts_shadow);
    CHECK_FALSE(scene.lights[0].casts_shadow);
    const Scene again = parse(scene_text(scene));
    CHECK_FALSE(again.objects[0].casts_shadow);
    CHECK_FALSE(again.lights[0].casts_shadow);
    CHECK(parse(any_sphere).objects[0].casts_shadow);

    CHECK_THAT(error_of_line("light { type = ambient intensity = 1 casts_shadow = no }"),
               ContainsSubstring("an ambient light casts no shadow anyway"));
    CHECK_THAT(error_of("sphere { center = (0, 0, 3) radius = 1 casts_shadow = 0 }"),
               ContainsSubstring("casts_shadow"));
}

}  // namespace packtrace::test
