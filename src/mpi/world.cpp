#include "mpi/world.hpp"

#include "cli/command.hpp"
#include "core/atomic_file.hpp"
#include "scene/language/quote.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <new>
#include <thread>

namespace packtrace::mpi {
namespace {

/// Why a step failed; empty for success.
struct Failure {
    std::string why;
    int exit_code = 0;
};

Failure attempt(const std::function<void()>& step)
{
    try {
        step();
    } catch (const JobFailed& failed) {
        throw;
    } catch (const CLI::Error& error) {
        return {std::string("packtrace-mpi: ") + error.what(), cli::exit_usage};
    } catch (...) {
        return {what_of(std::current_exception()), cli::exit_failed};
    }
    return {};
}

/// The position of this rank among the ranks of its node.
struct RanksOfNode {
    int number = 0;
    int size = 1;
};

/// All ranks must call it together.
RanksOfNode ranks_of_node()
{
    MPI_Comm node;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
    RanksOfNode ranks;
    MPI_Comm_rank(node, &ranks.number);
    MPI_Comm_size(node, &ranks.size);
    MPI_Comm_free(&node);
    return ranks;
}

/// The message of an exception. This function's own messages begin with `program`.
std::string why_failed(const std::exception_ptr& error, const std::string& program)
{
    try {
        std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
        return program + "not enough memory";
    } catch (const std::exception& known) {
        return known.what();
    } catch (...) {
        return program + "an error of an unknown kind";
    }
}

}  // namespace

std::string what_of(const std::exception_ptr& error)
{
    return why_failed(error, "packtrace-mpi: ");
}

void abort_job(const World& world, const std::exception_ptr& error)
{
    std::cerr << "packtrace-mpi: rank " << world.rank() << ": "
              << language::escape(why_failed(error, "")) << std::endl;
    remove_all_temporaries();
    MPI_Abort(MPI_COMM_WORLD, cli::exit_failed);
    std::_Exit(cli::exit_failed);
}

World::World(int& argc, char**& argv)
{
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    if (provided < MPI_THREAD_FUNNELED) {
        if (is_first())
            std::cerr << "packtrace-mpi: this MPI allows no threads; use one with "
                         "MPI_THREAD_FUNNELED\n";
        MPI_Finalize();
        std::exit(1);
    }
    link_ = ranks_of_node().size == size_ ? Link::memory : Link::network;
}

World::~World()
{
    MPI_Finalize();
}

// MPI's own waiting would occupy a processor that others need for work or measurements.
void World::sleep_until_all_are_here() const
{
    constexpr std::chrono::microseconds longest{2000};
    MPI_Request all;
    MPI_Ibarrier(MPI_COMM_WORLD, &all);
    int here = 0;
    for (std::chrono::microseconds nap{20};; nap = std::min(2 * nap, longest)) {
        MPI_Test(&all, &here, MPI_STATUS_IGNORE);
        if (here != 0)
            return;
        std::this_thread::sleep_for(nap);
    }
}

void World::together(const std::function<void()>& step) const
{
    const Failure failure = attempt(step);
    sleep_until_all_are_here();
    const int mine = failure.exit_code != 0 ? rank_ : size_;
    int first = size_;
    MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (first == size_)
        return;
    if (rank_ == first)
        // escape() makes one line of it, even if names of files have line ends.
        std::cerr << language::escape(failure.why) << '\n';
    int code = failure.exit_code;
    MPI_Bcast(&code, 1, MPI_INT, first, MPI_COMM_WORLD);
    throw JobFailed{code};
}

std::vector<std::string> World::gather(const std::string& text) const
{
    const int length = static_cast<int>(text.size());
    std::vector<int> lengths(static_cast<std::size_t>(size_));
    MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::vector<int> places(lengths.size());
    int total = 0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        places[i] = total;
        total += lengths[i];
    }
    std::string all(static_cast<std::size_t>(total), '\0');
    MPI_Allgatherv(text.data(), length, MPI_BYTE, all.data(), lengths.data(), places.data(),
                   MPI_BYTE, MPI_COMM_WORLD);
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < lengths.size(); ++i)
        texts.push_back(
            all.substr(static_cast<std::size_t>(places[i]), static_cast<std::size_t>(lengths[i])));
    return texts;
}

std::vector<int> World::node_leaders() const
{
    const int number = ranks_of_node().number;
    std::vector<int> numbers(static_cast<std::size_t>(size_));
    MPI_Allgather(&number, 1, MPI_INT, numbers.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::vector<int> leaders;
    for (int rank = 0; rank < size_; ++rank)
        if (numbers[static_cast<std::size_t>(rank)] == 0)
            leaders.push_back(rank);
    return leaders;
}

std::string World::host() const
{
    std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
    int length = 0;
    MPI_Get_processor_name(name.data(), &length);
    return {name.data(), static_cast<std::size_t>(length)};
}

}  // namespace packtrace::mpi
