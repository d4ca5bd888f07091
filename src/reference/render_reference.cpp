#include "reference/render_reference.hpp"

#include "reference/reference.hpp"

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

}  // namespace

template <class Real>
Image<Real> render_reference(const Scene& scene, int threads,
                             const std::function<void(double)>& progress)
{
    const reference::Reference<Real> reference(scene);
    Image<Real> image(scene.width, scene.height);
    RowCounter counter(image.height, progress);
    const auto trace_rows = [&](const tbb::blocked_range<int>& rows) {
        for (int j = rows.begin(); j != rows.end(); ++j) {
            reference.trace_row(j, image);
            counter.row_done();
        }
    };
    run_on_threads(threads, [&] {
        tbb::parallel_for(tbb::blocked_range<int>(0, image.height, 1), trace_rows,
                          tbb::simple_partitioner());
    });
    return image;
}

template Image<float> render_reference(const Scene&, int, const std::function<void(double)>&);
template Image<double> render_reference(const Scene&, int, const std::function<void(double)>&);
template Image<long double> render_reference(const Scene&, int, const std::function<void(double)>&);

}  // namespace packtrace
