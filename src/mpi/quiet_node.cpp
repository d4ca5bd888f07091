#include "mpi/quiet_node.hpp"

namespace packtrace::mpi {
namespace {

/// Holds a lock for reading or writing.
class Held {
public:
    Held(pthread_rwlock_t* lock, int (*take)(pthread_rwlock_t*)) : lock_(lock)
    {
        take(lock_);
    }
    ~Held()
    {
        pthread_rwlock_unlock(lock_);
    }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;

private:
    pthread_rwlock_t* lock_;
};

/// Releases a lock held for reading, and takes it again in the destructor.
class Released {
public:
    explicit Released(pthread_rwlock_t* lock) : lock_(lock)
    {
        pthread_rwlock_unlock(lock_);
    }
    ~Released()
    {
        pthread_rwlock_rdlock(lock_);
    }
    Released(const Released&) = delete;
    Released& operator=(const Released&) = delete;

private:
    pthread_rwlock_t* lock_;
};

void make_lock(pthread_rwlock_t* lock)
{
    pthread_rwlockattr_t attributes;
    pthread_rwlockattr_init(&attributes);
    pthread_rwlockattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED);
#ifdef __GLIBC__
    // Prefer writers. Otherwise ranks that work in parallel could keep a measurement waiting.
    pthread_rwlockattr_setkind_np(&attributes, PTHREAD_RWLOCK_PREFER_WRITER_NONRECURSIVE_NP);
#endif
    pthread_rwlock_init(lock, &attributes);
    pthread_rwlockattr_destroy(&attributes);
}

}  // namespace

QuietNode::QuietNode()
{
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node_);
    int rank = 0;
    MPI_Comm_rank(node_, &rank);
    MPI_Win_allocate_shared(rank == 0 ? sizeof(pthread_rwlock_t) : 0, 1, MPI_INFO_NULL, node_,
                            &lock_, &window_);
    MPI_Aint size = 0;
    int unit = 0;
    MPI_Win_shared_query(window_, 0, &size, &unit, &lock_);
    if (rank == 0)
        make_lock(lock_);
    MPI_Barrier(node_);
}

QuietNode::~QuietNode()
{
    MPI_Win_free(&window_);
    MPI_Comm_free(&node_);
}

void QuietNode::side_by_side(const std::function<void()>& work) const
{
    const Held held(lock_, pthread_rwlock_rdlock);
    work();
}

void QuietNode::alone(const std::function<void()>& timed) const
{
    const Released released(lock_);
    const Held held(lock_, pthread_rwlock_wrlock);
    timed();
}

}  // namespace packtrace::mpi
