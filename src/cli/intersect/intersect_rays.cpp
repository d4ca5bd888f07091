#include "cli/intersect/intersect_rays.hpp"

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>

namespace packtrace::cli {
namespace {

// A block between two stages. Errors wait in it for their turn, so that the first wrong line
// is the one reported, whichever block was worked on first.
struct Task {
    RayBlock block;
    std::string rows;
    std::exception_ptr error;
};

// Runs a stage's step unless an earlier one failed.
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

// Fills `task`; stops the pipeline behind the last block or the first error.
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
    // Two blocks a thread: one to work on, one that waits.
    const std::size_t blocks =
        2 * tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    // Held here, as a pipeline that ends early loses what is between its stages. Blocks are written
    // in the order they are read in, and so many are under way at most: a place is free again when
    // its turn comes.
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
