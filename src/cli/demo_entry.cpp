#include "cli/demo_entry.hpp"

#include <algorithm>
#include <chrono>

#include <packtrace/isa.hpp>
#include <packtrace/render.hpp>
#include <packtrace/renderer.hpp>

namespace packtrace::cli {
namespace {

template <class Work>
double seconds_of(const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Real>
void render_packets(const Scene& scene, DemoEntry& entry)
{
    RenderOptions options;
    options.isa = entry.isa;
    options.threads = entry.threads;
    const Renderer<Real> renderer(scene, options);
    Image<Real> image;
    // A renderer's first frame pays for the memory that later ones reuse.
    entry.rays = renderer.render(image).total();
    entry.seconds.push_back(seconds_of([&] { static_cast<void>(renderer.render(image)); }));
    entry.image = convert<double>(image);
}

template <class Real>
void render_scalar(const Scene& scene, DemoEntry& entry)
{
    RenderOptions options;
    options.kernel = Kernel::scalar;
    options.threads = entry.threads;
    Image<Real> image;
    entry.seconds.push_back(seconds_of([&] { image = render<Real>(scene, options); }));
    entry.image = convert<double>(image);
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

void render_entry(const Scene& scene, DemoEntry& entry)
{
    if (entry.packet)
        entry.single ? render_packets<float>(scene, entry) : render_packets<double>(scene, entry);
    else
        entry.single ? render_scalar<float>(scene, entry) : render_scalar<double>(scene, entry);
}

double median_seconds(const DemoEntry& entry)
{
    std::vector<double> sorted = entry.seconds;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 != 0 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2.0;
}

}  // namespace packtrace::cli
