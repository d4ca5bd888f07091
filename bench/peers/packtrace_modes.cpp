#include "packtrace_modes.hpp"

#include "camera_tiles.hpp"
#include "pass_timer.hpp"
#include <packtrace/intersect.hpp>

#include <memory>

namespace packtrace::peers {
namespace {

double trace_stream(const RayScene<float>& scene, const RaySet& rays, Query query, Hits& hits)
{
    PassTimer watch;
    for (std::size_t first = 0; first < rays.size(); first += chunk_size) {
        const auto view = rays.view(first, std::min(chunk_size, rays.size() - first));
        const HitsView<float> to{hits.t.data() + first, hits.object.data() + first, {}, {}, {}};
        watch.measure([&] {
            if (query == Query::closest)
                scene.closest_hits(view, to);
            else
                scene.occluded(view, hits.occluded.data() + first);
        });
    }
    return watch.seconds();
}

Tracer stream_tracer(const Scene& scene, const PacktraceMode& mode)
{
    const RenderOptions options{.isa = mode.isa, .accuracy = mode.accuracy};
    const auto rays = std::make_shared<const RayScene<float>>(scene, options);
    return {"packtrace " + mode.name + " stream", Side::packtrace, false,
            [rays](const RaySet& set, Query query, Hits& hits) {
                return trace_stream(*rays, set, query, hits);
            }};
}

Tracer tile_tracer(const Scene& scene, const PacktraceMode& mode)
{
    const auto tiles = std::make_shared<CameraTiles>(scene, mode.isa, mode.accuracy);
    return {"packtrace " + mode.name + " tiles", Side::packtrace, true,
            [tiles](const RaySet&, Query, Hits& hits) { return tiles->trace(hits); }};
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
