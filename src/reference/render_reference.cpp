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

/// Some rows of a picture: those asked for, or with those beside them that contrast looks at.
struct Rows {
    int first = 0;
    int end = 0;

    [[nodiscard]] int count() const
    {
        return end - first;
    }
    [[nodiscard]] bool has(int j) const
    {
        return j >= first && j < end;
    }
};

template <class Real>
class RowTracer {
public:
    RowTracer(const reference::Reference<Real>& reference, const RenderOptions& options,
              const Rows& rows, reference::CutCounter* cuts)
        : reference_(reference),
          options_(options),
          rows_(rows),
          cuts_(cuts),
          counter_(options.adaptive ? 2 * rows.count() : rows.count(), options.progress)
    {
    }

    void trace(Image<Real>& image)
    {
        if (options_.samples == 1)
            each_row(rows_,
                     [&](int j, Cuts* cuts) { reference_.trace_row(j, image, cuts, rows_.first); });
        else
            trace_all(image, rows_, sample_pattern(options_.samples));
    }

    /// All pixels once, those of `around` too; then those with contrast in full.
    void trace_adaptive(Image<Real>& image, const Rows& around)
    {
        Image<Real> wide(image.width, around.count());
        trace_all(wide, around, {Vec2(0.5)});
        ContrastMap<Real> contrast(wide, *options_.adaptive);
        for (int row = 0; row < wide.height; ++row)
            contrast.mark_row(row);
        const std::vector<Vec2> pattern = sample_pattern(options_.samples);
        each_row(rows_, [&](int j, Cuts* cuts) {
            for (int i = 0; i < wide.width; ++i)
                if (contrast(i, j - around.first))
                    put_pixel(wide, i, j - around.first,
                              reference_.trace_samples(i, j, pattern, cuts));
        });
        std::copy_n(wide.pixel(0, rows_.first - around.first), image.rgb.size(), image.rgb.begin());
    }

private:
    using Cuts = reference::CutCounter;

    /// `image` holds `rows`.
    void trace_all(Image<Real>& image, const Rows& rows, const std::vector<Vec2>& places)
    {
        each_row(rows, [&](int j, Cuts* cuts) {
            for (int i = 0; i < image.width; ++i)
                put_pixel(image, i, j - rows.first, reference_.trace_samples(i, j, places, cuts));
        });
    }

    // Rows count by themselves: their sums do not depend on threads. Only those asked for do.
    template <class Work>
    void each_row(const Rows& rows, const Work& work)
    {
        tbb::parallel_for(
            tbb::blocked_range<int>(rows.first, rows.end, 1),
            [&](const tbb::blocked_range<int>& some) {
                for (int j = some.begin(); j != some.end(); ++j) {
                    work_on(j, work);
                    if (rows_.has(j))
                        counter_.row_done();
                }
            },
            tbb::simple_partitioner());
    }

    template <class Work>
    void work_on(int j, const Work& work)
    {
        if (cuts_ == nullptr || !rows_.has(j))
            return work(j, nullptr);
        Cuts row = cuts_->fresh();
        work(j, &row);
        const std::lock_guard lock(adding_);
        cuts_->add(row);
    }

    const reference::Reference<Real>& reference_;
    const RenderOptions& options_;
    Rows rows_;
    Cuts* cuts_;
    RowCounter counter_;
    std::mutex adding_;
};

}  // namespace

template <class Real>
void render_reference_rows(const reference::Reference<Real>& reference, int picture_height,
                           const RenderOptions& options, int first, Image<Real>& image,
                           reference::CutCounter* cuts)
{
    const Rows rows{first, first + image.height};
    RowTracer<Real> tracer(reference, options, rows, cuts);
    run_on_threads(options.threads, [&] {
        if (options.adaptive)
            tracer.trace_adaptive(
                image, {std::max(0, rows.first - 1), std::min(picture_height, rows.end + 1)});
        else
            tracer.trace(image);
    });
}

template <class Real>
Image<Real> render_reference(const Scene& scene, const RenderOptions& options,
                             reference::CutCounter* cuts)
{
    Image<Real> image(scene.width, scene.height);
    const reference::Reference<Real> reference(scene, {}, options.self_hits);
    render_reference_rows(reference, scene.height, options, 0, image, cuts);
    return image;
}

template Image<float> render_reference(const Scene&, const RenderOptions&, reference::CutCounter*);
template Image<double> render_reference(const Scene&, const RenderOptions&, reference::CutCounter*);
template Image<long double> render_reference(const Scene&, const RenderOptions&,
                                             reference::CutCounter*);
template void render_reference_rows(const reference::Reference<float>&, int, const RenderOptions&,
                                    int, Image<float>&, reference::CutCounter*);
template void render_reference_rows(const reference::Reference<double>&, int, const RenderOptions&,
                                    int, Image<double>&, reference::CutCounter*);
template void render_reference_rows(const reference::Reference<long double>&, int,
                                    const RenderOptions&, int, Image<long double>&,
                                    reference::CutCounter*);

}  // namespace packtrace
