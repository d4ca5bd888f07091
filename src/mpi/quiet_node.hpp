#pragma once

#include "mpi/world.hpp"

#include <functional>
#include <pthread.h>

namespace packtrace::mpi {

/// Lets the ranks of a node work in parallel, except while one of them measures times: then all
/// others wait. All ranks construct and destroy it together. Its other functions do not call MPI.
class QuietNode {
public:
    QuietNode();
    ~QuietNode();
    QuietNode(const QuietNode&) = delete;
    QuietNode& operator=(const QuietNode&) = delete;

    /// Runs work in parallel with that of the node's other ranks.
    void side_by_side(const std::function<void()>& work) const;

    /// Call it within side_by_side(). Waits until no other rank of the node works, and lets none
    /// begin before `timed` ends.
    void alone(const std::function<void()>& timed) const;

private:
    MPI_Comm node_ = MPI_COMM_NULL;
    MPI_Win window_ = MPI_WIN_NULL;
    pthread_rwlock_t* lock_ = nullptr;
};

}  // namespace packtrace::mpi
