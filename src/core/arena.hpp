#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <iterator>
#include <list>
#include <map>
#include <mutex>

namespace packtrace {

/// An arena with a given number of threads, for one piece of work. Arenas are reused, because TBB
/// does not release all their memory (oneTBB 2021.8: some 10 kB each).
class BorrowedArena {
public:
    explicit BorrowedArena(int threads)
    {
        {
            const std::lock_guard lock(idle().mutex);
            left_ = &idle().of_threads[threads];
            arena_.splice(arena_.begin(), *left_, left_->begin(),
                          left_->empty() ? left_->begin() : std::next(left_->begin()));
        }
        if (arena_.empty())
            arena_.emplace_back(threads);
    }

    BorrowedArena(const BorrowedArena&) = delete;
    BorrowedArena& operator=(const BorrowedArena&) = delete;

    ~BorrowedArena()
    {
        const std::lock_guard lock(idle().mutex);
        left_->splice(left_->begin(), arena_);
    }

    template <class Work>
    auto execute(const Work& work)
    {
        return arena_.front().execute(work);
    }

private:
    using Arenas = std::list<tbb::task_arena>;

    struct Idle {
        std::mutex mutex;
        std::map<int, Arenas> of_threads;
    };

    /// Never destroyed, because threads may still work while the program ends.
    static Idle& idle()
    {
        static Idle& arenas = *new Idle;
        return arenas;
    }

    Arenas arena_;  ///< this one
    Arenas* left_;
};

/// Runs `work` on the given number of threads; for 0, on those of the caller's arena. The number is
/// limited to what TBB allows, because TBB warns on standard error about more.
template <class Work>
auto run_on_threads(int threads, const Work& work)
{
    if (threads == 0)
        return work();
    const std::size_t allowed =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    BorrowedArena arena(static_cast<int>(std::min(static_cast<std::size_t>(threads), allowed)));
    return arena.execute(work);
}

}  // namespace packtrace
