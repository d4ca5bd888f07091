#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace packtrace::mpi {

/// Thrown on all ranks after one of them has printed what is wrong.
struct JobFailed {
    int exit_code = 1;
};

/// The message of any exception, in one line.
[[nodiscard]] std::string what_of(const std::exception_ptr& error);

/// Splits `bytes` bytes into messages, because counts of MPI are int. Calls `use` with the
/// beginning and the size of each message.
template <class Use>
void in_messages(std::size_t bytes, const Use& use)
{
    constexpr std::size_t largest_message = std::size_t{1} << 30;
    for (std::size_t at = 0; at < bytes; at += largest_message)
        use(at, static_cast<int>(std::min(largest_message, bytes - at)));
}

/// The link between the ranks.
enum class Link {
    memory,  ///< all ranks are on one node: rank 0 need not help when others take a number
    network
};

/// Initialises and finalises MPI, and exchanges data between ranks. Only the thread that
/// constructed it may call MPI.
class World {
public:
    World(int& argc, char**& argv);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    [[nodiscard]] int rank() const
    {
        return rank_;
    }
    [[nodiscard]] int size() const
    {
        return size_;
    }
    [[nodiscard]] bool is_first() const
    {
        return rank_ == 0;
    }

    [[nodiscard]] Link link() const
    {
        return link_;
    }

    /// Runs `step` on every rank and sleeps until all have finished it. If it throws, the lowest
    /// rank that failed says why in one line, and all ranks throw JobFailed.
    void together(const std::function<void()>& step) const;

    /// Copies rank 0's text, bytes or numbers to every rank.
    template <class Values>
    void broadcast(Values& values) const
    {
        std::uint64_t count = values.size();
        MPI_Bcast(&count, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
        values.resize(count);
        const std::span<std::byte> bytes = std::as_writable_bytes(std::span(values));
        in_messages(bytes.size(), [&](std::size_t at, int size) {
            MPI_Bcast(bytes.data() + at, size, MPI_BYTE, 0, MPI_COMM_WORLD);
        });
    }
    /// Returns the texts of all ranks, on every rank.
    [[nodiscard]] std::vector<std::string> gather(const std::string& text) const;

    /// The first rank of each node, in order. All ranks must call it together.
    [[nodiscard]] std::vector<int> node_leaders() const;
    [[nodiscard]] std::string host() const;

private:
    void sleep_until_all_are_here() const;

    int rank_ = 0;
    int size_ = 1;
    Link link_ = Link::network;
};

/// Ends the job on all ranks, and says which rank failed and why. For errors outside of
/// World::together(), after which the other ranks would wait for ever. Only the thread that calls
/// MPI may call it; other threads may still work.
[[noreturn]] void abort_job(const World& world, const std::exception_ptr& error);

}  // namespace packtrace::mpi
