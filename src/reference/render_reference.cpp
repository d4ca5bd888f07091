#include "reference/render_reference.hpp"

#include "image/contrast.hpp"
#include "reference/reference.hpp"
#include "scene/sample_pattern.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <mutex>

namespace packtrace {
namespace {

// Counts finished rows and passes their share on, one thread at a time.
class RowCounter {
public:
    RowCounter(int rows, const std::function<void(double)>& progress)
        : rows_(rows), progress_(progress)
    {
    }
    void row_done()
    {
        if (!progress_)
            return;
        const std::lock_guard lock(mutex_);
        progress_(static_cast<double>(++done_) / rows_);
    }

private:
    int rows_;
    int done_ = 0;
    const std::function<void(double)>& progress_;
    std::mutex mutex_;
};

// Runs `work` on `threads` threads, also where the machine has fewer (TBB would warn and use
// what there is), or in the present arena for 0.
template <class Work>
void run_on_threads(int threads, const Work& work)
{
    if (threads <= 0)
        return work();
    using tbb::global_control;
    const std::size_t allowed =
        global_control::active_value(global_control::max_allowed_parallelism);
    const global_control raised(global_control::max_allowed_parallelism,
                                std::max(allowed, static_cast<std::size_t>(threads)));
    tbb::task_arena(threads).execute(work);
}

// The samples of render.hpp, in its order; `each_row` calls work for all rows.
template <class Real, class EachRow>
void trace_samples(const reference::Reference<Real>& reference, const RenderOptions& options,
                   Image<Real>& image, const EachRow& each_row)
{
    const std::vector<Vec2> pattern = sample_pattern(options.samples);
    const auto trace_pixels = [&](int j, reference::CutCounter* cuts,
                                  const std::vector<Vec2>& places, const auto& wanted) {
        for (int i = 0; i < image.width; ++i)
            if (wanted(i, j))
                put_pixel(image, i, j, reference.trace_samples(i, j, places, cuts));
    };
    const auto all = [](int, int) { return true; };
    using Cuts = reference::CutCounter;
    if (!options.adaptive)
        return each_row([&](int j, Cuts* cuts) { trace_pixels(j, cuts, pattern, all); });
    each_row([&](int j, Cuts* cuts) { trace_pixels(j, cuts, {Vec2(0.5)}, all); });
    ContrastMap<Real> contrast(image, *options.adaptive);
    for (int j = 0; j < image.height; ++j)
        contrast.mark_row(j);
    each_row([&](int j, Cuts* cuts) { trace_pixels(j, cuts, pattern, contrast); });
}

}  // namespace

template <class Real>
Image<Real> render_reference(const Scene& scene, const RenderOptions& options,
                             reference::CutCounter* cuts)
{
    Image<Real> image(scene.width, scene.height);
    const reference::Reference<Real> reference(scene, {}, options.self_hits);
    RowCounter counter(options.adaptive ? 2 * image.height : image.height, options.progress);
    std::mutex adding;
    // Rows count by themselves: their sums do not depend on threads.
    const auto work_on = [&](int j, const auto& work) {
        if (cuts == nullptr)
            return work(j, cuts);
        reference::CutCounter row = cuts->fresh();
        work(j, &row);
        const std::lock_guard lock(adding);
        cuts->add(row);
    };
    const auto each_row = [&](const auto& work) {
        tbb::parallel_for(
            tbb::blocked_range<int>(0, image.height, 1),
            [&](const tbb::blocked_range<int>& rows) {
                for (int j = rows.begin(); j != rows.end(); ++j) {
                    work_on(j, work);
                    counter.row_done();
                }
            },
            tbb::simple_partitioner());
    };
    run_on_threads(options.threads, [&] {
        if (options.samples == 1)
            each_row(
                [&](int j, reference::CutCounter* row) { reference.trace_row(j, image, row); });
        else
            trace_samples(reference, options, image, each_row);
    });
    return image;
}

template Image<float> render_reference(const Scene&, const RenderOptions&, reference::CutCounter*);
template Image<double> render_reference(const Scene&, const RenderOptions&, reference::CutCounter*);
template Image<long double> render_reference(const Scene&, const RenderOptions&,
                                             reference::CutCounter*);

}  // namespace packtrace
