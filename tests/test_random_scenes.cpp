#include "broken_scenes.hpp"
#include "catch.hpp"
#include "refusal.hpp"
#include "render/ray_columns.hpp"
#include "same_scene.hpp"
#include "scene/language/rows.hpp"
#include "scene_text.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>
#include <packtrace/validate.hpp>
#include <packtrace/write_scene.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

// Random scenes built in code, valid and broken. The scalar kernel, packets and the scene's text
// agree on a scene, or all refuse it with the same words.
namespace packtrace::test {
namespace {

RenderOptions options_of(Kernel kernel, Accuracy accuracy = Accuracy::exact)
{
    return {.kernel = kernel, .accuracy = accuracy};
}

/// The message of each way to use a scene.
std::map<std::string, std::string> refusals(const Scene& scene)
{
    const RenderOptions packets = options_of(Kernel::packet);
    const RenderOptions scalar = options_of(Kernel::scalar);
    return {
        {"validate", refusal<SceneError>([&] { validate(scene); })},
        {"packets of floats", refusal<SceneError>([&] { (void)render<float>(scene, packets); })},
        {"packets of doubles", refusal<SceneError>([&] { (void)render<double>(scene, packets); })},
        {"scalar", refusal<SceneError>([&] { (void)render<double>(scene, scalar); })},
        {"rays by packets", refusal<SceneError>([&] { RayScene<float>(scene, packets); })},
        {"rays by the scalar kernel",
         refusal<SceneError>([&] { RayScene<double>(scene, scalar); })},
        {"text", refusal<SceneError>([&] { (void)scene_text(scene); })},
    };
}

/// The message without `x.scene:line:column: `.
std::string without_place(const std::string& message)
{
    std::size_t at = 0;
    for (int colon = 0; colon < 3; ++colon)
        at = message.find(':', at) + 1;
    return message.substr(at + 1);
}

void check_broken(unsigned seed, const Break& way)
{
    RandomScene random(seed);
    way.apply(random);
    const Scene& scene = random.scene;
    const auto all = refusals(scene);
    const std::string& words = all.at("validate");
    INFO(way.name << ", seed " << seed << ": " << words);
    if (words == "accepted" || words.find('\n') != std::string::npos)
        FAIL("not refused in a line");
    for (const auto& [use, said] : all)
        if (said != words)
            FAIL(use << " says " << said);
    if (way.has_text && without_place(error_of(language::write_unchecked(scene).text)) != words)
        FAIL("the reader says " << error_of(language::write_unchecked(scene).text));
}

RayColumns<double> scattered_rays(RandomScene& random, std::size_t count)
{
    RayColumns<double> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 org = random.vector(8.0);
        const Vec3 dir = Vec3(0, 0, 5) + random.vector(5.0) - 0.5 * org;
        rays.add(org, dir);
    }
    return rays;
}

std::vector<double> distances(const Scene& scene, Kernel kernel, const RayColumns<double>& rays)
{
    std::vector<double> t(rays.size());
    std::vector<std::int32_t> object(rays.size());
    RayScene<double>(scene, options_of(kernel))
        .closest_hits(rays.view(), {t.data(), object.data()});
    return t;
}

/// The number of rays on which the kernels disagree. Double cannot always decide where surfaces
/// intersect, end or are only touched.
std::size_t disagreements(const std::vector<double>& a, const std::vector<double>& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool near = a[i] == b[i] || std::abs(a[i] - b[i]) <= 1e-7 * (1.0 + b[i]);
        if (!near)
            ++count;
    }
    return count;
}

template <class Real>
bool is_real(const Image<Real>& picture)
{
    for (const Real value : picture.rgb)
        if (!std::isfinite(value))
            return false;
    return true;
}

void check_pictures(const Scene& scene, const Scene& read)
{
    const Image<double> picture = render<double>(scene, options_of(Kernel::packet));
    if (render<double>(read, options_of(Kernel::packet)).rgb != picture.rgb)
        FAIL("the text's picture is another");
    if (!is_real(picture) || !is_real(render<double>(scene, options_of(Kernel::scalar))) ||
        !is_real(render<float>(scene, options_of(Kernel::scalar))) ||
        !is_real(render<float>(scene, options_of(Kernel::packet))) ||
        !is_real(render<float>(scene, options_of(Kernel::packet, Accuracy::fast))))
        FAIL("a picture has NaN or infinity");
}

/// Returns the share of rays on which the kernels disagree.
double check_valid(unsigned seed)
{
    RandomScene random(seed);
    const Scene& scene = random.scene;
    INFO("seed " << seed);
    const std::string words = refusal<SceneError>([&] { validate(scene); });
    if (words != "accepted")
        FAIL(words);
    const std::string text = scene_text(scene);
    const Scene read = parse(text);
    if (!same(scene, read) || scene_text(read) != text)
        FAIL("reads back as another scene:\n" << text);
    check_pictures(scene, read);

    const RayColumns<double> rays = scattered_rays(random, 64);
    const std::size_t apart = disagreements(distances(scene, Kernel::packet, rays),
                                            distances(scene, Kernel::scalar, rays));
    // If one kernel did not see an object, more rays would differ.
    if (apart > 3)
        FAIL(apart << " of 64 rays hit something else:\n" << text);
    return static_cast<double>(apart) / 64.0;
}

void check_many(unsigned first, unsigned count)
{
    double apart = 0.0;
    for (unsigned seed = first; seed < first + count; ++seed)
        apart += check_valid(seed);
    CHECK(apart / count < 1e-3);

    const std::vector<Break> ways = all_breaks();
    for (unsigned i = 0; i < count; ++i)
        check_broken(first + i, ways[i % ways.size()]);
}

}  // namespace

TEST_CASE("every way to break a scene is refused by all kernels with the same words",
          "[random_scenes]")
{
    unsigned seed = 1;
    for (const Break& way : all_breaks())
        for (int i = 0; i < 3; ++i)
            check_broken(seed++, way);
}

TEST_CASE("scalar, packets and text agree on random scenes, or refuse them with the same words",
          "[random_scenes]")
{
    check_many(1000, 1000);
}

/// $PACKTRACE_RANDOM_SCENES sets the number of scenes, half of them broken.
TEST_CASE("scalar, packets and text agree on a hundred thousand scenes", "[random_scenes][slow]")
{
    const char* const wanted = std::getenv("PACKTRACE_RANDOM_SCENES");
    const unsigned scenes = wanted != nullptr ? static_cast<unsigned>(std::atoi(wanted)) : 100'000;
    check_many(100'000, scenes / 2);
}

}  // namespace packtrace::test
