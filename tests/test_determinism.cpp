// The picture has the same bits for every packet width and number of threads.
#include "catch.hpp"
#include "packet_scenes.hpp"
#include "render_scene.hpp"
#include "same_bits.hpp"
#include <packtrace/compare.hpp>

#include <tbb/global_control.h>

namespace packtrace::test {
namespace {

/// Lets TBB use this number of threads, even if the machine has fewer.
class Parallelism {
public:
    explicit Parallelism(std::size_t threads)
        : control_(tbb::global_control::max_allowed_parallelism, threads)
    {
    }

private:
    tbb::global_control control_;
};

}  // namespace

TEMPLATE_TEST_CASE("the picture is the same for every width with fused multiply-add",
                   "[determinism]", float, double)
{
    for (const NamedScene& named : packet_scenes()) {
        Image<TestType> first;
        for (const std::string& isa : fused_isas()) {
            CAPTURE(named.name, isa);
            const Image<TestType> picture = render_packets<TestType>(named.scene, isa);
            if (first.rgb.empty())
                first = picture;
            CHECK(same_bits(picture, first));
        }
    }
}

TEST_CASE("the picture is the same for every width and number of threads in every mode",
          "[determinism]")
{
    const Parallelism seven(7);
    for (const Accuracy accuracy : {Accuracy::fast, Accuracy::exact})
        for (const SelfHits self_hits : {SelfHits::note, SelfHits::exact})
            for (const NamedScene& named : packet_scenes()) {
                Image<float> first;
                for (const std::string& isa : fused_isas())
                    for (const int threads : {1, 7}) {
                        CAPTURE(named.name, isa, threads, static_cast<int>(accuracy));
                        RenderOptions options{.isa = isa,
                                              .accuracy = accuracy,
                                              .self_hits = self_hits,
                                              .threads = threads};
                        const Image<float> picture = render<float>(named.scene, options);
                        if (first.rgb.empty())
                            first = picture;
                        CHECK(same_bits(picture, first));
                    }
            }
}

TEST_CASE("the picture of note 001 in full size is the same for every width", "[determinism][slow]")
{
    const Scene scene = four_spheres(1024, 1024);
    Image<float> first;
    for (const std::string& isa : fused_isas()) {
        CAPTURE(isa);
        const Image<float> picture = render_packets<float>(scene, isa);
        if (first.rgb.empty())
            first = picture;
        CHECK(same_bits(picture, first));
    }
}

TEMPLATE_TEST_CASE("the picture is the same for every number of threads", "[determinism]", float,
                   double)
{
    const Parallelism seven(7);
    for (const Scene& scene : {four_spheres(301, 203), random_spheres(60, 9), checkered_room(8)})
        for (const std::string& isa : supported_isas()) {
            const Image<TestType> one = render_packets<TestType>(scene, isa, 1);
            for (const int threads : {0, 2, 7}) {
                CAPTURE(isa, threads);
                CHECK(same_bits(render_packets<TestType>(scene, isa, threads), one));
            }
        }
}

TEST_CASE("a renderer gives the same picture every time", "[determinism]")
{
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        const Renderer<float> renderer(four_spheres(117, 85), {.isa = isa});
        Image<float> first;
        (void)renderer.render(first);
        Image<float> again(117, 85);
        std::fill(again.rgb.begin(), again.rgb.end(), 7.0f);
        for (int run = 0; run < 5; ++run) {
            (void)renderer.render(again);
            CHECK(same_bits(again, first));
        }
    }
}

TEST_CASE("pictures with and without fused multiply-add are close", "[determinism]")
{
    const Scene scene = four_spheres(251, 251);
    const auto isas = supported_isas();
    if (fused_isas().empty() || isas.front() != "sse42")
        return;
    const Image<float> plain = render_packets<float>(scene, "sse42");
    const Image<float> fused = render_packets<float>(scene, fused_isas().front());
    CHECK(compare(plain, fused).rmse <= 2e-4);
}

}  // namespace packtrace::test
