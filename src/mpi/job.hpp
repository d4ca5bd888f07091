#pragma once

#include "image/bytes.hpp"
#include "mpi/hand_out.hpp"
#include "mpi/world.hpp"
#include <packtrace/render.hpp>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace packtrace::mpi {

/// A finished piece of work.
struct Piece {
    int number = 0;
    Bytes bytes;
    CutRays cut;
    /// Why there are no bytes; empty for success. The first piece, in order, with an error ends the
    /// job.
    std::string error;
};

/// The work of one rank.
struct RankReport {
    std::int64_t pieces = 0;
    std::uint64_t rays = 0;
    std::uint64_t bytes_sent = 0;
    double busy = 0.0;     ///< seconds of work
    double waiting = 0.0;  ///< seconds without work
};

/// A counter on rank 0 that every rank can read and increment atomically. It distributes work
/// without a master. All ranks construct and destroy it together.
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
    /// From now on every rank gets numbers beyond the work.
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

/// Distributes pieces of work to all ranks and collects them on rank 0 in order. Each rank makes
/// pieces on a separate thread. Only the thread that calls run() calls MPI. All ranks construct it
/// together, for one run.
class Job {
public:
    /// `pieces` is the number of pieces that are sent to rank 0, which may be 0. Rank 0 holds at
    /// most `window` of them (window_of()).
    Job(const World& world, int pieces, int window) : Job(world, pieces, window, world.link())
    {
    }
    /// For another link between the ranks.
    Job(const World& world, int pieces, int window, Link link);
    ~Job();

    /// Returns the next number to the working thread. Numbers count from 0 over all ranks.
    using Next = std::function<std::int64_t()>;
    /// Makes a piece, and adds its rays to the report.
    using Make = std::function<Piece(int number, RankReport& report)>;
    /// Receives the pieces on rank 0, in order, on a separate thread.
    using Take = std::function<void(Piece piece)>;
    /// Works until Next returns no more work. Sets the report's pieces, rays and busy seconds.
    using Work = std::function<void(const Next& next, RankReport& report)>;

    /// Makes all pieces. Returns the reports of all ranks, on every rank. If a rank fails, one line
    /// says why, and all ranks throw JobFailed.
    std::vector<RankReport> run(const Make& make, const Take& take);

    /// For work whose results are not sent to rank 0; otherwise as above.
    std::vector<RankReport> run(const Work& work);

private:
    struct Sending;

    std::vector<RankReport> run(const Work& work, const Take& take);
    void run_threads(const Work& work, const Take& take);
    void work_all(const Work& work);
    void write_all(const Take& take);
    std::int64_t ask();
    void hand_over(Piece piece);

    bool step();
    bool answer(std::unique_lock<std::mutex>& lock);
    bool send_finished(std::unique_lock<std::mutex>& lock);
    bool receive_pieces();
    bool receive_one(int tag);
    void rest();
    [[nodiscard]] std::chrono::microseconds nap() const;
    [[nodiscard]] bool is_over();
    [[nodiscard]] bool nothing_left() const;
    void fail(const std::string& why);

    const World& world_;
    Link link_;
    Counter counter_;
    std::mutex mutex_;
    std::condition_variable changed_;
    RankReport report_;

    // Shared by the working thread and the thread that calls MPI.
    bool asks_ = false;
    std::optional<std::int64_t> given_;
    std::deque<Piece> finished_;
    int on_their_way_ = 0;
    bool works_ = true;
    std::vector<std::unique_ptr<Sending>> sending_;
    std::chrono::steady_clock::time_point last_busy_;  ///< last time with work for MPI

    // Used on rank 0.
    PieceWindow window_;
    std::map<int, Piece> here_;
    int ranks_at_work_;
    bool stopped_ = false;
    std::string failure_;
    bool failed_ = false;
};

}  // namespace packtrace::mpi
