#pragma once

#include <functional>
#include <string>
#include <vector>

#include <mpi.h>

namespace packtrace::mpi {

/// Thrown on all ranks alike when one of them has said what is wrong.
struct JobFailed {
    int exit_code = 1;
};

/// MPI from its start to its end, and what ranks tell each other. Only the thread that made it
/// calls MPI.
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

    /// Runs `step` on every rank and sleeps until all have done so. Where it throws, the lowest
    /// rank that failed says why in one line, and all throw JobFailed.
    void together(const std::function<void()>& step) const;

    /// Rank 0's text, on every rank.
    void broadcast(std::string& text) const;
    void broadcast(std::vector<int>& numbers) const;
    /// Every rank's text, on every rank.
    [[nodiscard]] std::vector<std::string> gather(const std::string& text) const;

    /// The first rank of each node, in order. Called by all ranks together.
    [[nodiscard]] std::vector<int> node_leaders() const;
    [[nodiscard]] std::string host() const;

private:
    void sleep_until_all_are_here() const;

    int rank_ = 0;
    int size_ = 1;
};

}  // namespace packtrace::mpi
