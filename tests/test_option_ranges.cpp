#include "catch.hpp"
#include "refusal.hpp"
#include <packtrace/certainty.hpp>
#include <packtrace/compare.hpp>
#include <packtrace/image.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/profile.hpp>
#include <packtrace/render.hpp>
#include <packtrace/report.hpp>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

using namespace packtrace;
using packtrace::test::refusal;

namespace {

Scene one_ball()
{
    Scene scene;
    scene.width = scene.height = 8;
    scene.objects.push_back({.surface = Sphere{{0, 0, 5}, 1}});
    return scene;
}

std::string of_render(int threads, Kernel kernel = Kernel::packet)
{
    return refusal<std::invalid_argument>(
        [&] { return render<float>(one_ball(), {.kernel = kernel, .threads = threads}); });
}

std::string of_report(const std::function<void(ReportOptions&)>& change)
{
    ReportOptions options{.repetitions = 1};
    change(options);
    return refusal<std::invalid_argument>([&] { (void)report({"ball", one_ball()}, options); });
}

std::string of_profile(const std::function<void(ProfileOptions&)>& change)
{
    ProfileOptions options{.repetitions = 1};
    change(options);
    return refusal<std::invalid_argument>([&] { (void)profile<float>("", one_ball(), options); });
}

}  // namespace

TEST_CASE("the number of threads is from 1 to 1024, or 0 for all", "[option_ranges]")
{
    for (const Kernel kernel : {Kernel::packet, Kernel::scalar})
        for (const int threads : {-3, 1025, 100000}) {
            INFO(threads);
            CHECK(of_render(threads, kernel) ==
                  "threads: " + std::to_string(threads) + "; choose from 0 to 1024");
        }
    CHECK(of_render(1024) == "accepted");
    CHECK(refusal<std::invalid_argument>([&] {
              (void)find_certainty(one_ball(), {.threads = 1025});
          }) == "threads: 1025; choose from 0 to 1024");
    CHECK(of_profile([](ProfileOptions& options) { options.threads = 0; }) ==
          "threads: 0; choose from 1 to 1024");
    CHECK(of_report([](ReportOptions& options) {
              options.threads = {1, -1};
          }) == "threads: -1; choose from 1 to 1024");
}

TEST_CASE("values that an enumeration lacks are refused", "[option_ranges]")
{
    const auto refused = [](const auto& change, const std::string& wanted) {
        RenderOptions options;
        change(options);
        CHECK(refusal<std::invalid_argument>([&] { (void)render<float>(one_ball(), options); }) ==
              wanted);
        CHECK(refusal<std::invalid_argument>([&] { RayScene<double>(one_ball(), options); }) ==
              wanted);
    };
    refused([](RenderOptions& options) { options.kernel = static_cast<Kernel>(5); },
            "kernel: 5; choose from 0 to 1");
    refused([](RenderOptions& options) { options.accuracy = static_cast<Accuracy>(7); },
            "accuracy: 7; choose from 0 to 1");
    refused([](RenderOptions& options) { options.self_hits = static_cast<SelfHits>(-1); },
            "self_hits: -1; choose from 0 to 1");
    refused([](RenderOptions& options) { options.traversal = static_cast<Traversal>(9); },
            "traversal: 9; choose from 0 to 2");
}

TEST_CASE("the scalar kernel refuses options that only packets have", "[option_ranges]")
{
    const auto refused = [](const auto& change, const std::string& choice) {
        RenderOptions options{.kernel = Kernel::scalar};
        change(options);
        const std::string wanted = "the scalar kernel has no " + choice +
                                   ", only packets do; leave it out or use the packet kernel";
        CHECK(refusal<std::invalid_argument>([&] { (void)render<float>(one_ball(), options); }) ==
              wanted);
        CHECK(refusal<std::invalid_argument>([&] { RayScene<double>(one_ball(), options); }) ==
              wanted);
    };
    refused([](RenderOptions& options) { options.isa = "avx2"; }, "isa");
    refused([](RenderOptions& options) { options.width = 8; }, "lanes");
    refused([](RenderOptions& options) { options.traversal = Traversal::tree; }, "traversal");
    refused([](RenderOptions& options) { options.accuracy = Accuracy::fast; }, "fast accuracy");
    refused([](RenderOptions& options) { options.force_general = true; }, "force_general");
}

TEST_CASE("reports and profiles refuse settings that they can't measure with", "[option_ranges]")
{
    for (const int repetitions : {0, -1, 1001}) {
        const std::string wanted =
            "repetitions: " + std::to_string(repetitions) + "; choose from 1 to 1000";
        CHECK(of_report([&](ReportOptions& options) { options.repetitions = repetitions; }) ==
              wanted);
        CHECK(of_profile([&](ProfileOptions& options) { options.repetitions = repetitions; }) ==
              wanted);
    }
    CHECK(of_report([](ReportOptions& options) {
              options.isas = {"foo"};
          }).find("unknown instruction set 'foo'") != std::string::npos);
    CHECK(of_report([](ReportOptions& options) { options.truth_samples = 1000000000; }) ==
          "truth_samples: 1000000000; choose from 2 to 1024");
    CHECK(of_report([](ReportOptions& options) { options.classified = -1; }) ==
          "classified: -1; choose from 0 to 2147483647");
    CHECK(of_report([](ReportOptions& options) { options.threshold = std::nan(""); }) ==
          "threshold: nan; choose a finite number >= 0");
}

TEST_CASE("invalid sides of images, numbers of times and thresholds are refused", "[option_ranges]")
{
    CHECK(refusal<std::invalid_argument>([] { (void)Image<float>(-1, 5); }) ==
          "image: -1 x 5 pixels; sides are 0 or above");
    CHECK(refusal<std::invalid_argument>([] { (void)cost_picture({}, 5, 5); }) ==
          "cost_picture: 0 times for a picture of 5 x 5 pixels; give each pixel one");
    const Image<float> image(2, 2);
    CHECK(refusal<std::invalid_argument>([&] {
              (void)compare(image, image, {.threshold = -1.0});
          }) == "threshold: -1; choose a finite number >= 0");
}
