#include "cli/commands/demo_entry.hpp"

#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>
#include <packtrace/renderer.hpp>

#include "lab/harness/stopwatch.hpp"

namespace packtrace::cli {
namespace {

template <class Real>
double render_packets(const Scene& scene, DemoEntry& entry)
{
    RenderOptions options;
    options.isa = entry.isa;
    options.threads = entry.threads;
    const Renderer<Real> renderer(scene, options);
    Image<Real> image;
    // A renderer's first frame pays for the memory that later ones reuse.
    entry.rays = renderer.render(image).total();
    const double seconds =
        seconds_of(entry.threads, [&] { static_cast<void>(renderer.render(image)); });
    entry.image = convert<double>(image);
    return seconds;
}

template <class Real>
double render_scalar(const Scene& scene, DemoEntry& entry)
{
    RenderOptions options;
    options.kernel = Kernel::scalar;
    options.threads = entry.threads;
    Image<Real> image;
    const double seconds = seconds_of(entry.threads, [&] { image = render<Real>(scene, options); });
    entry.image = convert<double>(image);
    return seconds;
}

}  // namespace

std::vector<DemoEntry> demo_entries(int threads)
{
    std::vector<DemoEntry> entries;
    for (const bool single : {false, true}) {
        DemoEntry entry;
        entry.single = single;
        entries.push_back(entry);
        entry.packet = true;
        for (const IsaInfo& isa : list_isas()) {
            entry.isa = isa.name;
            entry.lanes = single ? isa.lanes_single : isa.lanes_double;
            if (isa.supported)
                entries.push_back(entry);
        }
    }
    if (threads > 1 && entries.back().packet) {
        entries.push_back(entries.back());
        entries.back().threads = threads;
    }
    return entries;
}

double render_entry(const Scene& scene, DemoEntry& entry)
{
    if (entry.packet)
        return entry.single ? render_packets<float>(scene, entry)
                            : render_packets<double>(scene, entry);
    return entry.single ? render_scalar<float>(scene, entry) : render_scalar<double>(scene, entry);
}

}  // namespace packtrace::cli
