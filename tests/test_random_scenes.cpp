#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>
#include <packtrace/validate.hpp>
#include <packtrace/write_scene.hpp>

#include "broken_scenes.hpp"
#include "catch.hpp"
#include "same_scene.hpp"
#include "scene/language/rows.hpp"
#include "scene_text.hpp"

// Random scenes built in code, valid ones and broken ones: the scalar kernel, packets and the
// scene's text agree, or all of them refuse it with the same words.
namespace packtrace::test {
namespace {

std::string refusal(const auto& use)
{
    try {
        use();
    } catch (const SceneError& error) {
        return error.what();
    }
    return "accepted";
}

RenderOptions options_of(Kernel kernel, Accuracy accuracy = Accuracy::exact)
{
    RenderOptions options;
    options.kernel = kernel;
    options.accuracy = accuracy;
    return options;
}

/// What each way to use a scene says of it.
std::map<std::string, std::string> refusals(const Scene& scene)
{
    const RenderOptions packets = options_of(Kernel::packet);
    const RenderOptions scalar = options_of(Kernel::scalar);
    return {
        {"validate", refusal([&] { validate(scene); })},
        {"packets of floats", refusal([&] { (void)render<float>(scene, packets); })},
        {"packets of doubles", refusal([&] { (void)render<double>(scene, packets); })},
        {"scalar", refusal([&] { (void)render<double>(scene, scalar); })},
        {"rays by packets", refusal([&] { RayScene<float>(scene, packets); })},
        {"rays by the scalar kernel", refusal([&] { RayScene<double>(scene, scalar); })},
        {"text", refusal([&] { (void)scene_text(scene); })},
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

struct Rays {
    std::array<std::vector<double>, 8> columns;

    explicit Rays(RandomScene& random, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 org = random.vector(8.0);
            const Vec3 dir = Vec3(0, 0, 5) + random.vector(5.0) - 0.5 * org;
            const double numbers[] = {org.x, org.y, org.z, dir.x,
                                      dir.y, dir.z, 0.0,   std::numeric_limits<double>::infinity()};
            for (std::size_t column = 0; column < columns.size(); ++column)
                columns[column].push_back(numbers[column]);
        }
    }

    [[nodiscard]] RaysView<double> view() const
    {
        const auto& c = columns;
        return {c[0].data(), c[1].data(), c[2].data(), c[3].data(), c[4].data(),
                c[5].data(), c[6].data(), c[7].data(), c[0].size()};
    }
};

struct Hits {
    std::vector<double> t;
    std::vector<std::int32_t> object;

    Hits(const Scene& scene, Kernel kernel, const Rays& rays)
        : t(rays.columns[0].size()), object(t.size())
    {
        HitsView<double> view;
        view.t = t.data();
        view.object = object.data();
        RayScene<double>(scene, options_of(kernel)).closest_hits(rays.view(), view);
    }
};

/// Rays on which the kernels do not agree, which double can't always tell where surfaces cross,
/// end or are only touched.
std::size_t disagreements(const Hits& a, const Hits& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.t.size(); ++i) {
        const bool near = a.t[i] == b.t[i] || std::abs(a.t[i] - b.t[i]) <= 1e-7 * (1.0 + b.t[i]);
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

/// Returns the share of rays that the kernels do not agree on.
double check_valid(unsigned seed)
{
    RandomScene random(seed);
    const Scene& scene = random.scene;
    INFO("seed " << seed);
    const std::string words = refusal([&] { validate(scene); });
    if (words != "accepted")
        FAIL(words);
    const std::string text = scene_text(scene);
    const Scene read = parse(text);
    if (!same(scene, read) || scene_text(read) != text)
        FAIL("reads back as another scene:\n" << text);
    check_pictures(scene, read);

    const Rays rays(random, 64);
    const std::size_t apart =
        disagreements(Hits(scene, Kernel::packet, rays), Hits(scene, Kernel::scalar, rays));
    // An object that one kernel does not see is missed by more.
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

TEST_CASE("every way to break a scene is refused by all with the same words", "[random_scenes]")
{
    unsigned seed = 1;
    for (const Break& way : all_breaks())
        for (int i = 0; i < 3; ++i)
            check_broken(seed++, way);
}

TEST_CASE("scalar, packets and text agree on random scenes, or refuse alike", "[random_scenes]")
{
    check_many(1000, 1000);
}

/// $PACKTRACE_RANDOM_SCENES is how many scenes, half of them broken.
TEST_CASE("scalar, packets and text agree on a hundred thousand scenes", "[random_scenes][slow]")
{
    const char* const wanted = std::getenv("PACKTRACE_RANDOM_SCENES");
    const unsigned scenes = wanted != nullptr ? static_cast<unsigned>(std::atoi(wanted)) : 100'000;
    check_many(100'000, scenes / 2);
}

}  // namespace packtrace::test
