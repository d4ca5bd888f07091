#pragma once

#include "mpi/world.hpp"

#include <functional>
#include <pthread.h>

namespace packtrace::mpi {

/// A node on which ranks work side by side, but for what one of them times: all others then wait.
/// Made and unmade by all ranks together; its other functions call no MPI.
class QuietNode {
public:
    QuietNode();
    ~QuietNode();
    QuietNode(const QuietNode&) = delete;
    QuietNode& operator=(const QuietNode&) = delete;

    /// Runs work that others of the node may work beside.
    void side_by_side(const std::function<void()>& work) const;

    /// Within such work: waits until no other rank of the node works, and lets none begin before
    /// `timed` ends.
    void alone(const std::function<void()>& timed) const;

private:
    MPI_Comm node_ = MPI_COMM_NULL;
    MPI_Win window_ = MPI_WIN_NULL;
    pthread_rwlock_t* lock_ = nullptr;
};

}  // namespace packtrace::mpi
