// packtrace_cluster_messages: the times of messages between two MPI ranks, as JSON, for
// results/cluster.py.
#include "core/seconds_since.hpp"
#include "mpi/job.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <iostream>
#include <vector>

namespace packtrace::mpi {
namespace {

using Clock = std::chrono::steady_clock;

/// Seconds of one message, by sending messages from rank 0 to rank 1 and back.
double one_way(const World& world, int bytes, int times)
{
    std::vector<char> text(static_cast<std::size_t>(bytes));
    const auto go = [&] {
        const bool first = world.is_first();
        for (int step = 0; step < 2; ++step)
            if ((step == 0) == first)
                MPI_Send(text.data(), bytes, MPI_BYTE, first ? 1 : 0, 0, MPI_COMM_WORLD);
            else
                MPI_Recv(text.data(), bytes, MPI_BYTE, first ? 1 : 0, 0, MPI_COMM_WORLD,
                         MPI_STATUS_IGNORE);
    };
    go();
    MPI_Barrier(MPI_COMM_WORLD);
    const auto start = Clock::now();
    for (int i = 0; i < times; ++i)
        go();
    return seconds_since(start) / (2.0 * times);
}

/// Seconds for rank 1 to take a number from the counter while rank 0 waits inside MPI.
double counter_seconds(const World& world, int times)
{
    Counter counter(world);
    double seconds = 0.0;
    if (!world.is_first()) {
        const auto start = Clock::now();
        for (int i = 0; i < times; ++i)
            (void)counter.next();
        seconds = seconds_since(start) / times;
    }
    MPI_Bcast(&seconds, 1, MPI_DOUBLE, 1, MPI_COMM_WORLD);
    return seconds;
}

/// The same in a job, with the job's threads, and with rank 0 sleeping between its turns.
double job_seconds(const World& world, int times)
{
    double seconds = 0.0;
    // As if the ranks were on two machines.
    Job job(world, 0, 0, Link::network);
    (void)job.run([&](const Job::Next& next, RankReport&) {
        if (world.is_first())
            return;
        const auto start = Clock::now();
        for (int i = 0; i < times; ++i)
            (void)next();
        seconds = seconds_since(start) / times;
    });
    MPI_Bcast(&seconds, 1, MPI_DOUBLE, 1, MPI_COMM_WORLD);
    return seconds;
}

void measure(const World& world, int band_bytes)
{
    const double latency = one_way(world, 8, 2000);
    const double band = one_way(world, band_bytes, 100);
    const double counter = counter_seconds(world, 2000);
    const double job = job_seconds(world, 500);
    if (world.is_first())
        std::cout << nlohmann::ordered_json{{"latency", latency},
                                            {"bytes_per_second", band_bytes / (band - latency)},
                                            {"counter_round_trip", counter},
                                            {"job_round_trip", job}}
                         .dump(1)
                  << '\n';
}

}  // namespace
}  // namespace packtrace::mpi

int main(int argc, char** argv)
{
    const packtrace::mpi::World world(argc, argv);
    if (world.size() != 2 || argc != 2) {
        if (world.is_first())
            std::cerr << "usage: mpirun -n 2 packtrace_cluster_messages BYTES\n";
        return 2;
    }
    packtrace::mpi::measure(world, std::stoi(argv[1]));
    return 0;
}
