#include "reference/render_reference.hpp"

#include "core/arena.hpp"
#include "core/progress.hpp"
#include "image/contrast.hpp"
#include "reference/reference.hpp"
#include "scene/sample_pattern.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <cstddef>
#include <mutex>

namespace packtrace {
namespace {

template <class Real>
class RegionTracer {
public:
    RegionTracer(const reference::Reference<Real>& reference, const RenderOptions& options,
                 const Region& region, reference::CutCounter* cuts)
        : reference_(reference),
          options_(options),
          region_(region),
          cuts_(cuts),
          rows_(options.adaptive ? 2 * region.height : region.height, options.progress,
                options.stop)
    {
    }

    void trace(Image<Real>& image)
    {
        if (options_.samples == 1)
            each_pixel(region_, [&](int i, int j, Cuts* cuts) {
                put_pixel(image, i - region_.x, j - region_.y, reference_.trace_pixel(i, j, cuts));
            });
        else
            trace_all(image, region_, sample_pattern(options_.samples));
    }

    /// Traces one sample for each pixel of `around`, then all samples of the region's pixels with
    /// contrast.
    void trace_adaptive(Image<Real>& image, const Region& around)
    {
        Image<Real> wide(around.width, around.height);
        trace_all(wide, around, {Vec2(0.5)});
        ContrastMap<Real> contrast(wide, *options_.adaptive);
        for (int row = 0; row < wide.height; ++row)
            contrast.mark_row(row);
        const std::vector<Vec2> pattern = sample_pattern(options_.samples);
        each_pixel(region_, [&](int i, int j, Cuts* cuts) {
            if (contrast(i - around.x, j - around.y))
                put_pixel(wide, i - around.x, j - around.y,
                          reference_.trace_samples(i, j, pattern, cuts));
        });
        copy_region({region_.x - around.x, region_.y - around.y, region_.width, region_.height},
                    wide, image);
    }

private:
    using Cuts = reference::CutCounter;

    /// `image` holds `part`. Only pixels of the region are added to the cuts.
    void trace_all(Image<Real>& image, const Region& part, const std::vector<Vec2>& places)
    {
        each_pixel(part, [&](int i, int j, Cuts* cuts) {
            put_pixel(
                image, i - part.x, j - part.y,
                reference_.trace_samples(i, j, places, region_.contains(i, j) ? cuts : nullptr));
        });
    }

    /// Calls `work(i, j, cuts)` for the pixels of `part`. A stop is checked for at each pixel: a
    /// row of many samples in glass can take minutes.
    template <class Work>
    void each_pixel(const Region& part, const Work& work)
    {
        each_row(part, [&](int j, Cuts* cuts) {
            for (int i = part.x; i < part.x + part.width && !rows_.is_stopped(); ++i)
                work(i, j, cuts);
        });
    }

    // Each row has its own counter, so that the sums do not depend on threads.
    template <class Work>
    void each_row(const Region& part, const Work& work)
    {
        tbb::parallel_for(
            tbb::blocked_range<int>(part.y, part.y + part.height, 1),
            [&](const tbb::blocked_range<int>& some) {
                for (int j = some.begin(); j != some.end() && !rows_.is_stopped(); ++j) {
                    work_on(j, work);
                    if (region_.contains(region_.x, j) && !rows_.is_stopped())
                        rows_.finish_piece();
                }
            },
            tbb::simple_partitioner());
        rows_.check_stop();
    }

    template <class Work>
    void work_on(int j, const Work& work)
    {
        if (cuts_ == nullptr)
            return work(j, nullptr);
        Cuts row = cuts_->fresh();
        work(j, &row);
        const std::lock_guard lock(adding_);
        cuts_->add(row);
    }

    const reference::Reference<Real>& reference_;
    const RenderOptions& options_;
    Region region_;
    Cuts* cuts_;
    Progress rows_;
    std::mutex adding_;
};

/// `image` has the region's size.
template <class Real>
void trace_region(const reference::Reference<Real>& reference, const Region& picture,
                  const RenderOptions& options, const Region& region, Image<Real>& image,
                  reference::CutCounter* cuts)
{
    RegionTracer<Real> tracer(reference, options, region, cuts);
    run_on_threads(options.threads, [&] {
        if (options.adaptive)
            tracer.trace_adaptive(image, with_neighbours(region, picture.width, picture.height));
        else
            tracer.trace(image);
    });
}

}  // namespace

template <class Real>
void render_reference_rows(const reference::Reference<Real>& reference, int picture_height,
                           const RenderOptions& options, int first, Image<Real>& image,
                           reference::CutCounter* cuts)
{
    trace_region(reference, {0, 0, image.width, picture_height}, options,
                 {0, first, image.width, image.height}, image, cuts);
}

template <class Real>
Image<Real> render_reference(const Scene& scene, const RenderOptions& options,
                             reference::CutCounter* cuts)
{
    const Region picture{0, 0, scene.width, scene.height};
    const Region region = options.region.value_or(picture);
    Image<Real> image(region.width, region.height);
    const reference::Reference<Real> reference(scene, {}, options.self_hits);
    trace_region(reference, picture, options, region, image, cuts);
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
