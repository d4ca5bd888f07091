#include "lab/stress/stress_subject.hpp"

#include "core/seconds_since.hpp"
#include "lab/truth/textbook.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/isa.hpp>

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>

namespace packtrace::lab {
namespace {

/// The fastest of this many runs counts; no further run starts after this many seconds.
constexpr int timed_runs = 3;
constexpr double timed_seconds = 0.02;

template <class Work>
double fastest(const Work& work)
{
    double best = std::numeric_limits<double>::infinity();
    double sum = 0.0;
    for (int run = 0; run < timed_runs && sum < timed_seconds; ++run) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const double seconds = seconds_since(start);
        best = std::min(best, seconds);
        sum += seconds;
    }
    return best;
}

template <class Real>
StressRun run_ray_scene(const RenderOptions& options, const StressGroup& group)
{
    const RayScene<Real> scene(group.scene, options);
    const RayColumns<Real> columns = columns_of<Real>(group.rays);
    const RaysView<Real> rays = columns.view();
    HitColumns<Real> hits(rays.count);
    StressRun run;
    run.seconds = fastest([&] { scene.closest_hits(rays, hits.view()); });
    for (std::size_t i = 0; i < rays.count; ++i)
        run.answers.push_back(answer_of(hits, i));
    run.occluded.resize(rays.count);
    scene.occluded(rays, run.occluded.data());
    scene.all_hits(rays, [&](std::size_t, std::span<const SurfaceHit<Real>> all) {
        run.first.push_back(all.empty() ? -1 : all.front().object);
        run.crossings.push_back(all.size());
    });
    return run;
}

template <class Real>
StressRun run_textbook(const StressGroup& group)
{
    const TextbookScene<Real> scene(group.scene);
    StressRun run;
    run.answers.resize(group.rays.size());
    run.seconds = fastest([&] {
        for (std::size_t i = 0; i < group.rays.size(); ++i)
            run.answers[i] = scene.closest_hit(group.rays[i]);
    });
    return run;
}

void add_packets(const StressOptions& options, std::vector<StressSubject>& subjects)
{
    for (const StressMode& mode : stress_modes) {
        if (!wanted(options.modes, mode.name))
            continue;
        for (const IsaInfo& isa : list_isas()) {
            if (!isa.supported || !(options.isa.empty() || options.isa == isa.name))
                continue;
            const RenderOptions render{
                .isa = isa.name, .accuracy = mode.accuracy, .traversal = options.traversal};
            subjects.push_back({.kernel = "packet",
                                .mode = mode.name,
                                .isa = isa.name,
                                .exact = mode.exact,
                                .options = render});
        }
    }
}

}  // namespace

std::vector<StressSubject> stress_subjects(const StressOptions& options)
{
    std::vector<StressSubject> subjects;
    if (wanted(options.kernels, "textbook"))
        subjects.push_back({.kernel = "textbook"});
    if (wanted(options.kernels, "scalar"))
        subjects.push_back({.kernel = "scalar", .options = {.kernel = Kernel::scalar}});
    if (wanted(options.kernels, "packet"))
        add_packets(options, subjects);
    return subjects;
}

template <class Real>
StressRun run_subject(const StressSubject& subject, const StressGroup& group)
{
    return subject.kernel == "textbook" ? run_textbook<Real>(group)
                                        : run_ray_scene<Real>(subject.options, group);
}

template StressRun run_subject<float>(const StressSubject&, const StressGroup&);
template StressRun run_subject<double>(const StressSubject&, const StressGroup&);

}  // namespace packtrace::lab
