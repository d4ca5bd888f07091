#pragma once

#include <cstdint>
#include <limits>

#include "mpi/world.hpp"

namespace packtrace::mpi {

/// A number on rank 0 that every rank may take and raise at once: whose turn it is, without a
/// master. Made and unmade by all ranks together.
class Counter {
public:
    explicit Counter(const World& world)
    {
        MPI_Win_allocate(world.is_first() ? sizeof(std::int64_t) : 0, sizeof(std::int64_t),
                         MPI_INFO_NULL, MPI_COMM_WORLD, &number_, &window_);
        MPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
        if (world.is_first()) {
            const std::int64_t zero = 0;
            call(MPI_REPLACE, zero);
        }
        MPI_Barrier(MPI_COMM_WORLD);
    }
    ~Counter()
    {
        MPI_Win_unlock_all(window_);
        MPI_Win_free(&window_);
    }
    Counter(const Counter&) = delete;
    Counter& operator=(const Counter&) = delete;

    /// The next number, from 0.
    [[nodiscard]] std::int64_t next()
    {
        return call(MPI_SUM, 1);
    }
    /// From now on every rank gets numbers beyond all work.
    void stop()
    {
        call(MPI_REPLACE, std::numeric_limits<std::int64_t>::max() / 2);
    }

private:
    std::int64_t call(MPI_Op operation, std::int64_t operand)
    {
        std::int64_t before = 0;
        MPI_Fetch_and_op(&operand, &before, MPI_INT64_T, 0, 0, operation, window_);
        MPI_Win_flush(0, window_);
        return before;
    }

    std::int64_t* number_ = nullptr;
    MPI_Win window_ = MPI_WIN_NULL;
};

}  // namespace packtrace::mpi
