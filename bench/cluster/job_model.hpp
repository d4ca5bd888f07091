#pragma once

#include "mpi/hand_out.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <queue>
#include <utility>
#include <vector>

// Simulates a job of packtrace-mpi on many ranks. It distributes the work with the program's own
// code; the times of work and messages are given.
namespace packtrace::bench {

/// A job, in seconds and bytes.
struct ModelJob {
    int ranks = 1;
    int pieces = 1;
    std::function<double(int piece)> work;  ///< to make a piece
    double piece_bytes = 0.0;               ///< sent to rank 0; 0: pieces stay where they are made
    double write = 0.0;                     ///< to write a piece, on a thread of rank 0
    double latency = 0.0;                   ///< of a message
    double bytes_per_second = 1.0;          ///< that rank 0 receives
    double ask = 0.0;      ///< to get a number, besides two latencies: threads that wake each other
    double counter = 0.0;  ///< of the shared counter, for each number
};

/// The result of a simulation. Rank 0 has three parts, each of which does one thing at a time.
struct ModelRun {
    double seconds = 0.0;
    double working = 0.0;  ///< seconds of work, of all ranks together
    double counter_busy = 0.0;
    double link_busy = 0.0;
    double writer_busy = 0.0;
};

/// Simulates a job, event by event.
class JobModel {
public:
    explicit JobModel(const ModelJob& job)
        : job_(job),
          window_(comes_here() ? job.pieces : 0,
                  mpi::window_of(job.ranks, static_cast<std::size_t>(job.piece_bytes))),
          ranks_(static_cast<std::size_t>(job.ranks))
    {
    }

    [[nodiscard]] ModelRun run()
    {
        for (int rank = 0; rank < job_.ranks; ++rank)
            ask(rank);
        while (!events_.empty()) {
            const Event event = events_.top();
            events_.pop();
            now_ = event.time;
            handle(event);
        }
        run_.seconds = now_;
        return run_;
    }

private:
    enum class What { asks, gets_number, ends_work, is_announced, is_received, is_written };
    struct Event {
        double time;
        std::uint64_t order;  ///< of events at the same time
        What what;
        int rank;
        int piece;

        bool operator<(const Event& other) const
        {
            return time != other.time ? time > other.time : order > other.order;
        }
    };
    struct Rank {
        int on_their_way = 0;
        int waiting_piece = -1;  ///< a piece that rank 0 has no room for yet; -1: none
    };

    [[nodiscard]] bool comes_here() const
    {
        return job_.piece_bytes > 0.0;
    }
    [[nodiscard]] double latency_of(int rank) const
    {
        return rank == 0 ? 0.0 : job_.latency;
    }
    void at(double time, What what, int rank, int piece)
    {
        events_.push({time, next_order_++, what, rank, piece});
    }

    void handle(const Event& event)
    {
        switch (event.what) {
            case What::asks:
                return count(event.rank);
            case What::gets_number:
                return work(event.rank, event.piece);
            case What::ends_work:
                return hand_over(event.rank, event.piece);
            case What::is_announced:
                announced_[event.piece] = event.rank;
                break;
            case What::is_received:
                receive(event.rank, event.piece);
                break;
            case What::is_written:
                window_.leave(), writes_ = false;
                break;
        }
        go_on();
    }

    void ask(int rank)
    {
        at(now_ + latency_of(rank), What::asks, rank, 0);
    }

    /// The counter serves one rank after the other.
    void count(int rank)
    {
        counter_free_ = std::max(counter_free_, now_) + job_.counter;
        run_.counter_busy += job_.counter;
        at(counter_free_ + latency_of(rank) + job_.ask, What::gets_number, rank, next_number_++);
    }

    void work(int rank, int piece)
    {
        if (piece >= job_.pieces)
            return;
        const double seconds = job_.work(piece);
        run_.working += seconds;
        at(now_ + seconds, What::ends_work, rank, piece);
    }

    void hand_over(int rank, int piece)
    {
        Rank& state = ranks_[static_cast<std::size_t>(rank)];
        if (!comes_here())
            return ask(rank);
        const bool room =
            rank == 0 ? window_.admits(piece) : state.on_their_way < mpi::most_on_their_way;
        if (!room) {
            state.waiting_piece = piece;
            if (rank == 0)
                first_waits_ = true;
            return;
        }
        if (rank == 0) {
            window_.arrive(piece);
        } else {
            ++state.on_their_way;
            at(now_ + job_.latency, What::is_announced, rank, piece);
        }
        ask(rank);
        go_on();
    }

    /// A piece has arrived, and its sender is told.
    void receive(int rank, int piece)
    {
        window_.arrive(piece);
        receives_ = false;
        Rank& state = ranks_[static_cast<std::size_t>(rank)];
        --state.on_their_way;
        if (state.waiting_piece >= 0)
            at(now_ + job_.latency, What::ends_work, rank, std::exchange(state.waiting_piece, -1));
    }

    /// Starts what rank 0 can do now: write, hand over its own piece, or receive.
    void go_on()
    {
        if (!writes_ && window_.ready()) {
            writes_ = true;
            run_.writer_busy += job_.write;
            at(now_ + job_.write, What::is_written, 0, 0);
        }
        if (first_waits_ && window_.admits(ranks_[0].waiting_piece)) {
            first_waits_ = false;
            at(now_, What::ends_work, 0, std::exchange(ranks_[0].waiting_piece, -1));
        }
        if (receives_ || announced_.empty())
            return;
        const auto [piece, rank] = *announced_.begin();
        if (!window_.admits(piece))
            return;
        announced_.erase(announced_.begin());
        receives_ = true;
        const double seconds = 2.0 * job_.latency + job_.piece_bytes / job_.bytes_per_second;
        run_.link_busy += seconds;
        at(now_ + seconds, What::is_received, rank, piece);
    }

    const ModelJob& job_;
    mpi::PieceWindow window_;
    std::vector<Rank> ranks_;
    std::priority_queue<Event> events_;
    std::uint64_t next_order_ = 0;
    double now_ = 0.0;
    int next_number_ = 0;
    double counter_free_ = 0.0;
    std::map<int, int> announced_;  ///< ranks by the pieces that they have announced
    bool receives_ = false;
    bool writes_ = false;
    bool first_waits_ = false;
    ModelRun run_;
};

}  // namespace packtrace::bench
