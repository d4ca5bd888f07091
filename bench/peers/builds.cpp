#include "builds.hpp"

#include "embree_scene.hpp"
#include "pass_timer.hpp"
#include <packtrace/intersect.hpp>

#include <tbb/global_control.h>

#include <algorithm>
#include <malloc.h>
#include <string>

namespace packtrace::peers {
namespace {

struct Build {
    double seconds = 0.0;
    double bytes = 0.0;       ///< held after the build
    double peak_bytes = 0.0;  ///< 0 if unknown
};

Build build_embree(const std::vector<SphereRecord>& spheres, Geometry geometry, int threads)
{
    const EmbreeScene scene(spheres, geometry, threads);
    double bytes = static_cast<double>(scene.bytes());
    double peak = static_cast<double>(scene.peak_bytes());
    // The callbacks of user geometry read the caller's array; sphere geometry has a copy.
    if (geometry == Geometry::user) {
        bytes += static_cast<double>(spheres.size() * sizeof(SphereRecord));
        peak += static_cast<double>(spheres.size() * sizeof(SphereRecord));
    }
    return {scene.build_seconds(), bytes, peak};
}

double allocated_bytes()
{
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

Build build_packtrace(const Scene& scene, int threads)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    const double before = allocated_bytes();
    PassTimer watch;
    std::unique_ptr<RayScene<float>> made;
    watch.measure([&] { made = std::make_unique<RayScene<float>>(scene); });
    return {watch.seconds(), allocated_bytes() - before, 0.0};
}

struct Builder {
    std::string name;
    int threads;
    std::function<Build()> build;
    std::vector<double> seconds = {};
    Build last = {};
};

std::vector<Builder> builders(const Scene& scene, const std::vector<SphereRecord>& spheres)
{
    std::vector<Builder> all;
    for (const int threads : {1, 2}) {
        for (const Geometry geometry : {Geometry::sphere, Geometry::user})
            all.push_back({std::string("embree ") + name_of(geometry), threads,
                           [=, &spheres] { return build_embree(spheres, geometry, threads); }});
        all.push_back(
            {"packtrace", threads, [=, &scene] { return build_packtrace(scene, threads); }});
    }
    return all;
}

}  // namespace

nlohmann::ordered_json measure_builds(const Scene& scene, int repetitions)
{
    const std::vector<SphereRecord> spheres = sphere_records(scene);
    std::vector<Builder> all = builders(scene, spheres);
    for (int repetition = 0; repetition < repetitions; ++repetition)
        for (Builder& builder : all) {
            builder.last = builder.build();
            builder.seconds.push_back(builder.last.seconds);
        }
    const auto objects = static_cast<double>(spheres.size());
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (Builder& builder : all) {
        std::sort(builder.seconds.begin(), builder.seconds.end());
        json.push_back({{"side", builder.name},
                        {"threads", builder.threads},
                        {"objects", spheres.size()},
                        {"seconds", builder.seconds[builder.seconds.size() / 2]},
                        {"seconds_of_all", builder.seconds},
                        {"bytes_an_object", builder.last.bytes / objects}});
        if (builder.last.peak_bytes > 0.0)
            json.back()["peak_bytes_an_object"] = builder.last.peak_bytes / objects;
    }
    return json;
}

}  // namespace packtrace::peers
