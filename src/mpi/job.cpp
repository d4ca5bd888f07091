#include "mpi/job.hpp"

#include "core/seconds_since.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

namespace packtrace::mpi {
namespace {

using Clock = std::chrono::steady_clock;

/// How long a rank sleeps if MPI has no work for it. Waking up costs about 15 us of a processor
/// that other threads use.
constexpr std::chrono::microseconds shortest_nap{200};
constexpr std::chrono::microseconds longest_nap{2000};

/// The message before a piece's bytes.
struct Head {
    std::uint64_t bytes = 0;
    std::uint64_t error_bytes = 0;
    CutRays cut;
};

}  // namespace

/// A piece on its way to rank 0.
struct Job::Sending {
    Piece piece;
    Head head;
    std::vector<MPI_Request> requests;

    explicit Sending(Piece sent) : piece(std::move(sent))
    {
        head = {piece.bytes.size(), piece.error.size(), piece.cut};
        const auto send = [&](const auto& start, const void* bytes, int count) {
            requests.emplace_back();
            start(bytes, count, MPI_BYTE, 0, piece.number, MPI_COMM_WORLD, &requests.back());
        };
        send(MPI_Isend, &head, sizeof head);
        // With Issend, the bytes are sent only when rank 0 has room for them.
        in_messages(piece.bytes.size(), [&](std::size_t at, int count) {
            send(MPI_Issend, piece.bytes.data() + at, count);
        });
        if (!piece.error.empty())
            send(MPI_Issend, piece.error.data(), static_cast<int>(piece.error.size()));
    }

    [[nodiscard]] bool is_over()
    {
        int over = 0;
        MPI_Testall(static_cast<int>(requests.size()), requests.data(), &over, MPI_STATUSES_IGNORE);
        return over != 0;
    }
};

Job::Job(const World& world, int pieces, int window, Link link)
    : world_(world),
      link_(link),
      counter_(world),
      window_(pieces, window),
      ranks_at_work_(world.size() - 1)
{
}

Job::~Job() = default;

std::vector<RankReport> Job::run(const Make& make, const Take& take)
{
    const Work work = [&](const Next& next, RankReport& report) {
        for (std::int64_t number; (number = next()) < window_.count();) {
            const auto start = Clock::now();
            Piece piece;
            try {
                piece = make(static_cast<int>(number), report);
            } catch (...) {
                piece.error = what_of(std::current_exception());
            }
            piece.number = static_cast<int>(number);
            report.busy += seconds_since(start);
            ++report.pieces;
            hand_over(std::move(piece));
        }
    };
    return run(work, take);
}

std::vector<RankReport> Job::run(const Work& work)
{
    return run(work, [](Piece) {});
}

std::vector<RankReport> Job::run(const Work& work, const Take& take)
{
    const auto start = Clock::now();
    run_threads(work, take);
    // Rank 0 waits for the work of the other ranks.
    if (!world_.is_first()) {
        const char over = 0;
        MPI_Send(&over, 1, MPI_BYTE, 0, window_.count(), MPI_COMM_WORLD);
    }
    report_.waiting = seconds_since(start) - report_.busy;
    world_.together([&] {
        if (failed_)
            throw std::runtime_error(failure_);
    });
    std::vector<RankReport> reports(static_cast<std::size_t>(world_.size()));
    MPI_Allgather(&report_, sizeof report_, MPI_BYTE, reports.data(), sizeof report_, MPI_BYTE,
                  MPI_COMM_WORLD);
    return reports;
}

/// Runs the threads of this rank, and calls MPI for them until all work is done.
void Job::run_threads(const Work& work, const Take& take)
{
    std::thread worker;
    std::thread writer;
    try {
        last_busy_ = Clock::now();
        worker = std::thread([&] { work_all(work); });
        if (world_.is_first())
            writer = std::thread([&] { write_all(take); });
        while (!is_over())
            if (step())
                last_busy_ = Clock::now();
            else
                rest();
    } catch (...) {
        // Unwinding would never end: the threads wait for this one to call MPI, and all ranks must
        // destroy the counter together.
        abort_job(world_, std::current_exception());
    }
    worker.join();
    if (writer.joinable())
        writer.join();
}

void Job::work_all(const Work& work)
{
    std::string error;
    try {
        work([this] { return ask(); }, report_);
    } catch (...) {
        error = what_of(std::current_exception());
    }
    const std::scoped_lock lock(mutex_);
    works_ = false;
    if (!error.empty())
        fail(error);
    changed_.notify_all();
}

/// The caller must hold the mutex.
void Job::fail(const std::string& why)
{
    if (!failed_)
        failure_ = why;
    failed_ = true;
    changed_.notify_all();
}

std::int64_t Job::ask()
{
    std::unique_lock lock(mutex_);
    asks_ = true;
    given_.reset();
    changed_.notify_all();
    changed_.wait(lock, [&] { return given_.has_value(); });
    return *given_;
}

void Job::hand_over(Piece piece)
{
    std::unique_lock lock(mutex_);
    if (world_.is_first()) {
        changed_.wait(lock, [&] { return failed_ || window_.admits(piece.number); });
        if (failed_)
            return;
        const int number = piece.number;
        here_[number] = std::move(piece);
        window_.arrive(number);
    } else {
        changed_.wait(lock, [&] { return on_their_way_ < most_on_their_way; });
        ++on_their_way_;
        finished_.push_back(std::move(piece));
    }
    changed_.notify_all();
}

/// On rank 0: calls `take` with the pieces in order.
void Job::write_all(const Take& take)
{
    std::unique_lock lock(mutex_);
    while (!window_.empty()) {
        changed_.wait(lock, [&] { return failed_ || window_.ready(); });
        if (failed_)
            return;
        Piece piece = std::move(here_[window_.first()]);
        here_.erase(window_.first());
        if (!piece.error.empty())
            return fail(piece.error);
        lock.unlock();
        std::string error;
        try {
            take(std::move(piece));
        } catch (...) {
            error = what_of(std::current_exception());
        }
        lock.lock();
        if (!error.empty())
            return fail(error);
        window_.leave();
        changed_.notify_all();
    }
}

/// Does the present work for MPI. Returns whether there was any.
bool Job::step()
{
    bool stop = false;
    bool busy = false;
    {
        std::unique_lock lock(mutex_);
        busy = answer(lock);
        busy = send_finished(lock) || busy;
        stop = failed_ && !std::exchange(stopped_, failed_);
    }
    if (stop)
        counter_.stop();
    return (world_.is_first() && receive_pieces()) || busy;
}

/// Gets a number for the working thread.
bool Job::answer(std::unique_lock<std::mutex>& lock)
{
    if (!asks_)
        return false;
    asks_ = false;
    lock.unlock();
    const std::int64_t number = counter_.next();
    lock.lock();
    given_ = number;
    changed_.notify_all();
    return true;
}

bool Job::send_finished(std::unique_lock<std::mutex>& lock)
{
    bool busy = false;
    while (!finished_.empty()) {
        Piece piece = std::move(finished_.front());
        finished_.pop_front();
        report_.bytes_sent += piece.bytes.size() + sizeof(Head);
        lock.unlock();
        sending_.push_back(std::make_unique<Sending>(std::move(piece)));
        lock.lock();
        busy = true;
    }
    for (std::size_t i = 0; i < sending_.size();) {
        if (!sending_[i]->is_over()) {
            ++i;
            continue;
        }
        sending_.erase(sending_.begin() + static_cast<std::ptrdiff_t>(i));
        --on_their_way_;
        changed_.notify_all();
        busy = true;
    }
    return busy;
}

/// On rank 0: receives pieces of other ranks, as far as the window admits them.
bool Job::receive_pieces()
{
    int first = 0;
    int end = 0;
    bool failed = false;
    {
        const std::scoped_lock lock(mutex_);
        first = window_.first();
        end = window_.end();
        failed = failed_;
    }
    // Mostly there are no messages. This takes one probe instead of one per piece.
    int there = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
    if (there == 0)
        return false;
    bool busy = false;
    // After a failure receive all messages, so that no rank waits for ever.
    if (failed)
        busy = receive_one(MPI_ANY_TAG);
    for (int piece = first; piece < end && !failed; ++piece)
        busy = receive_one(piece) || busy;
    while (!failed && receive_one(window_.count()))
        busy = true;
    return busy;
}

bool Job::receive_one(int tag)
{
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &there, &status);
    if (there == 0)
        return false;
    const int source = status.MPI_SOURCE;
    tag = status.MPI_TAG;
    if (tag == window_.count()) {
        char over = 0;
        MPI_Recv(&over, 1, MPI_BYTE, source, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        --ranks_at_work_;
        return true;
    }
    Head head;
    MPI_Recv(&head, sizeof head, MPI_BYTE, source, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    Piece piece;
    piece.number = tag;
    piece.cut = head.cut;
    piece.bytes.resize(head.bytes);
    piece.error.resize(head.error_bytes);
    in_messages(piece.bytes.size(), [&](std::size_t at, int count) {
        MPI_Recv(piece.bytes.data() + at, count, MPI_BYTE, source, tag, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
    });
    if (!piece.error.empty())
        MPI_Recv(piece.error.data(), static_cast<int>(head.error_bytes), MPI_BYTE, source, tag,
                 MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    const std::scoped_lock lock(mutex_);
    if (!failed_) {
        window_.arrive(tag);
        here_[tag] = std::move(piece);
    }
    changed_.notify_all();
    return true;
}

/// Sleeps until there may be work. Threads wake it; only messages must be polled.
void Job::rest()
{
    std::unique_lock lock(mutex_);
    const auto called = [&] {
        return asks_ || !finished_.empty() || (failed_ && !stopped_) || nothing_left();
    };
    const bool expects_messages = world_.is_first() ? ranks_at_work_ > 0 : !sending_.empty();
    if (expects_messages)
        changed_.wait_for(lock, nap(), called);
    else
        changed_.wait(lock, called);
}

std::chrono::microseconds Job::nap() const
{
    // Ranks of other nodes get no number while rank 0 sleeps.
    if (link_ == Link::network)
        return shortest_nap;
    const auto since =
        std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - last_busy_);
    return std::clamp(since / 4, shortest_nap, longest_nap);
}

bool Job::is_over()
{
    const std::scoped_lock lock(mutex_);
    return nothing_left();
}

/// Whether this rank has no more work for MPI. The caller must hold the mutex.
bool Job::nothing_left() const
{
    const bool own = !works_ && finished_.empty() && sending_.empty() && (!failed_ || stopped_);
    if (!world_.is_first())
        return own;
    return own && ranks_at_work_ == 0 && (failed_ || window_.empty());
}

}  // namespace packtrace::mpi
