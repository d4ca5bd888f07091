#include "cli/intersect/intersect_rays.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

namespace packtrace::cli {

template <class Real>
BlockTracer<Real>::BlockTracer(const Scene& scene, const RenderOptions& options, RayQuery query,
                               RayBounds bounds)
    : scene_(scene, options), rows_(scene), query_(query), bounds_(bounds)
{
}

template <class Real>
std::string BlockTracer<Real>::rows_of(const RayBlock& block)
{
    Scratch& scratch = scratch_.local();
    read_rays(block.format, block.text, block.first_line, scratch.rays);
    std::string rows;
    switch (query_) {
        case RayQuery::closest:
            append_closest(rows, scratch);
            break;
        case RayQuery::all:
            append_all(rows, block.first_ray, scratch);
            break;
        case RayQuery::any:
            append_any(rows, scratch);
            break;
    }
    return rows;
}

template <class Real>
void BlockTracer<Real>::append_closest(std::string& rows, Scratch& s) const
{
    const RaysView<Real> rays = s.rays.view();
    s.hits.resize(rays.count);
    scene_.closest_hits(rays, s.hits.view());
    const bool bounded = bounds_ == RayBounds::proven;
    s.bounds.resize(bounded ? rays.count : 0);
    if (bounded)
        scene_.bound_closest_hits(rays, s.hits.object.data(), s.bounds.data());
    for (std::size_t i = 0; i < rays.count; ++i)
        rows_.append_closest(rows, s.hits[i], bounded ? &s.bounds[i] : nullptr);
}

template <class Real>
void BlockTracer<Real>::append_all(std::string& rows, std::uint64_t first_ray, Scratch& s) const
{
    const RaysView<Real> rays = s.rays.view();
    scene_.all_hits(rays, [&](std::size_t ray, std::span<const SurfaceHit<Real>> hits) {
        s.bounds.resize(bounds_ == RayBounds::proven ? hits.size() : 0);
        if (!s.bounds.empty())
            scene_.bound_all_hits(rays, ray, hits, s.bounds);
        rows_.append_all(rows, first_ray + ray, hits, s.bounds);
    });
}

template <class Real>
void BlockTracer<Real>::append_any(std::string& rows, Scratch& s) const
{
    const RaysView<Real> rays = s.rays.view();
    s.mask.resize(rays.count);
    scene_.occluded(rays, s.mask.data());
    for (const std::uint8_t hit : s.mask)
        HitRows::append_any(rows, hit);
}

template class BlockTracer<float>;
template class BlockTracer<double>;

namespace {

// A block between two stages. It also carries an error until its turn, so that the first wrong line
// is reported, whichever block was processed first.
struct Task {
    RayBlock block;
    std::string rows;
    std::exception_ptr error;
};

// Runs a step unless an earlier step of the block failed.
template <class Step>
void attempt(Task& task, const Step& step)
{
    if (task.error)
        return;
    try {
        step(task);
    } catch (...) {
        task.error = std::current_exception();
    }
}

// Reads a block into `task`. Stops the pipeline after the last block or the first error.
void read_block(Task& task, RayBlocks& rays, tbb::flow_control& control, bool& ended)
{
    task = {};
    if (!ended)
        attempt(task, [&](Task& reading) { reading.block = rays.next(); });
    if (ended || (!task.error && task.block.text.empty()))
        control.stop();
    ended = static_cast<bool>(task.error);
}

}  // namespace

template <class Real>
void intersect_rays(BlockTracer<Real>& tracer, RayBlocks& rays, const TakeRows& take)
{
    // Two blocks per thread: one is processed, one waits.
    const std::size_t blocks =
        2 * tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    // The tasks are stored here, because a pipeline that ends early leaks the data between its
    // stages. Blocks are written in the order of reading, and at most `blocks` are in the pipeline,
    // so a task is free again when its turn comes.
    std::vector<Task> tasks(blocks);
    std::size_t next = 0;
    bool ended = false;
    const auto read = [&](tbb::flow_control& control) {
        Task& task = tasks[next++ % blocks];
        read_block(task, rays, control, ended);
        return &task;
    };
    const auto trace = [&](Task* task) {
        attempt(*task, [&](Task& reading) { reading.rows = tracer.rows_of(reading.block); });
        return task;
    };
    const auto write = [&](const Task* task) {
        if (task->error)
            std::rethrow_exception(task->error);
        take(task->block, task->rows);
    };
    tbb::parallel_pipeline(
        blocks, tbb::make_filter<void, Task*>(tbb::filter_mode::serial_in_order, read) &
                    tbb::make_filter<Task*, Task*>(tbb::filter_mode::parallel, trace) &
                    tbb::make_filter<Task*, void>(tbb::filter_mode::serial_in_order, write));
}

template void intersect_rays(BlockTracer<float>&, RayBlocks&, const TakeRows&);
template void intersect_rays(BlockTracer<double>&, RayBlocks&, const TakeRows&);

}  // namespace packtrace::cli
