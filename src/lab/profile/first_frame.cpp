#include "lab/profile/first_frame.hpp"

#include <sys/resource.h>

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "lab/harness/stopwatch.hpp"
#include "lab/profile/profile_subjects.hpp"

namespace packtrace {
namespace {

/// Pages of memory that this program was given when it first touched them.
std::uint64_t page_faults()
{
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    return static_cast<std::uint64_t>(use.ru_minflt) + static_cast<std::uint64_t>(use.ru_majflt);
}

template <class Work>
FirstFrameStep step(const char* name, int threads, const Work& work)
{
    const std::uint64_t before = page_faults();
    const double seconds = seconds_of(threads, work);
    return {name, seconds, page_faults() - before};
}

void start_threads(int threads)
{
    tbb::task_arena arena(threads);
    arena.execute([threads] {
        tbb::parallel_for(0, threads, [](int) {}, tbb::static_partitioner());
    });
}

}  // namespace

template <class Real>
std::vector<FirstFrameStep> first_frame_steps(const Scene& scene, const ProfileOptions& options)
{
    const int threads = options.threads;
    std::vector<FirstFrameStep> steps;
    steps.push_back(step("threads started", threads, [threads] { start_threads(threads); }));
    const Renderer<Real> renderer(scene, render_options(options));
    // Both are kept: memory that is freed may come back warm.
    Image<Real> first, second;
    const auto frame = [&](const char* name, Image<Real>& image) {
        steps.push_back(step(name, threads, [&] { (void)renderer.render(image); }));
    };
    frame("first frame", first);
    frame("second frame, into other memory", second);
    frame("third frame, into the same", second);
    return steps;
}

template std::vector<FirstFrameStep> first_frame_steps<float>(const Scene&, const ProfileOptions&);
template std::vector<FirstFrameStep> first_frame_steps<double>(const Scene&, const ProfileOptions&);

}  // namespace packtrace
