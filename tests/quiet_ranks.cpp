// packtrace_quiet_ranks: the ranks of a node work side by side, and each measures times while the
// others are idle. Prints the number of nodes, then for each stage of each rank "RANK work|timed
// BEGIN END", by the machine's clock.
#include "mpi/quiet_node.hpp"
#include "mpi/world.hpp"

#include <chrono>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>

namespace packtrace::mpi {
namespace {

constexpr int repetitions = 20;

class Stages {
public:
    explicit Stages(const World& world) : rank_(world.rank())
    {
    }

    void pass(const std::string& kind)
    {
        const auto begin = std::chrono::steady_clock::now();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const auto end = std::chrono::steady_clock::now();
        lines_ << rank_ << ' ' << kind << ' ' << begin.time_since_epoch().count() << ' '
               << end.time_since_epoch().count() << '\n';
    }

    [[nodiscard]] std::string lines() const
    {
        return lines_.str();
    }

private:
    int rank_;
    std::ostringstream lines_;
};

void run(const World& world)
{
    const QuietNode node;
    Stages stages(world);
    // The barrier returns only if all ranks may work at once.
    node.side_by_side([] { MPI_Barrier(MPI_COMM_WORLD); });
    for (int i = 0; i < repetitions; ++i)
        node.side_by_side([&] {
            stages.pass("work");
            node.alone([&] { stages.pass("timed"); });
            stages.pass("work");
        });
    const std::size_t nodes = world.node_leaders().size();
    const std::vector<std::string> all = world.gather(stages.lines());
    if (!world.is_first())
        return;
    std::cout << nodes << '\n';
    for (const std::string& lines : all)
        std::cout << lines;
}

}  // namespace
}  // namespace packtrace::mpi

int main(int argc, char** argv)
{
    const packtrace::mpi::World world(argc, argv);
    packtrace::mpi::run(world);
    return 0;
}
