#include "packtrace_modes.hpp"

#include "camera_tiles.hpp"
#include "pass_timer.hpp"
#include <packtrace/intersect.hpp>

#include <algorithm>
#include <memory>

namespace packtrace::peers {
namespace {

/// Each chunk is a copy, as for Embree, so that both sides find their rays in the cache.
double trace_stream(const RayScene<float>& scene, const RaySet& rays, Query query, Hits& hits)
{
    RaySet chunk;
    Hits found(chunk_size);
    PassTimer watch;
    for (std::size_t first = 0; first < rays.size(); first += chunk_size) {
        const std::size_t count = std::min(chunk_size, rays.size() - first);
        const auto to = static_cast<std::ptrdiff_t>(first);
        chunk.copy(rays, first, count);
        const RaysView<float> view = chunk.view(0, count);
        if (query == Query::closest) {
            watch.measure([&] {
                scene.closest_hits(view, {found.t.data(), found.object.data(), {}, {}, {}});
            });
            std::copy_n(found.t.begin(), count, hits.t.begin() + to);
            std::copy_n(found.object.begin(), count, hits.object.begin() + to);
        } else {
            watch.measure([&] { scene.occluded(view, found.occluded.data()); });
            std::copy_n(found.occluded.begin(), count, hits.occluded.begin() + to);
        }
    }
    return watch.seconds();
}

Tracer stream_tracer(const Scene& scene, const PacktraceMode& mode)
{
    const RenderOptions options{.isa = mode.isa, .accuracy = mode.accuracy};
    const auto rays = std::make_shared<const RayScene<float>>(scene, options);
    return {.name = "packtrace " + mode.name + " stream",
            .side = Side::packtrace,
            .trace = [rays](const RaySet& set, Query query, Hits& hits) {
                return trace_stream(*rays, set, query, hits);
            }};
}

Tracer tile_tracer(const Scene& scene, const PacktraceMode& mode)
{
    const auto tiles = std::make_shared<CameraTiles>(scene, mode.isa, mode.accuracy);
    return {.name = "packtrace " + mode.name + " tiles",
            .side = Side::packtrace,
            .camera_only = true,
            .trace = [tiles](const RaySet&, Query, Hits& hits) { return tiles->trace(hits); }};
}

}  // namespace

std::vector<Tracer> packtrace_tracers(const Scene& scene, const std::vector<PacktraceMode>& modes)
{
    std::vector<Tracer> tracers;
    for (const PacktraceMode& mode : modes) {
        tracers.push_back(stream_tracer(scene, mode));
        tracers.push_back(tile_tracer(scene, mode));
    }
    return tracers;
}

}  // namespace packtrace::peers
