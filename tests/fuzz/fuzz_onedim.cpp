// Any line as a one-dimensional system: its text reads back as the same system, and all solvers
// agree.
#include "fuzzer.hpp"
#include <packtrace/onedim.hpp>

PACKTRACE_FUZZER(onedim)
{
    using namespace packtrace::onedim;
    using packtrace::fuzz::require;
    Systems systems;
    if (const auto error = read_system(packtrace::fuzz::text_of(bytes), systems)) {
        require(systems.size() == 0 && systems.surfaces.empty(), "an error leaves nothing behind");
        require(error->column >= 1 && error->column <= bytes.size() + 1, "an error has a column");
        return;
    }
    require(systems.size() == 1, "a line is one system");
    for (const Notation notation : {Notation::note, Notation::compact}) {
        Systems again;
        require(!read_system(to_text(systems[0], notation), again), "its text can be read");
        require(again.surfaces == systems.surfaces, "its text reads back as the same system");
    }
    // Sweeps of long systems take long.
    if (systems.surfaces.size() > 200)
        return;
    const Intensity seen = solve(systems[0]);
    for (const Solver solver : {Solver::scalar, Solver::linear, Solver::bitsliced})
        require(solve(systems, {solver, "auto"}).front() == seen, "all solvers agree");
}
