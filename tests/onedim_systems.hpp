#pragma once

#include "catch.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/onedim.hpp>

#include <random>
#include <string>
#include <vector>

namespace packtrace::test {

/// All 54 kinds of surface.
[[nodiscard]] inline std::vector<onedim::Surface> all_surfaces()
{
    std::vector<onedim::Surface> surfaces;
    for (const char* direction : {"T", "A"})
        for (const char* r : {"N", "M", "A"})
            for (const char* t : {"N", "M", "A"})
                for (const char* e : {"N", "M", "A"}) {
                    onedim::Systems one;
                    REQUIRE(!read_system(std::string(direction) + r + t + e, one));
                    surfaces.push_back(one.surfaces.front());
                }
    return surfaces;
}

/// A system of random surfaces. One surface in `dark` may emit: with few emitters light travels
/// far.
[[nodiscard]] inline std::vector<onedim::Surface> random_system(std::mt19937& random,
                                                                std::size_t length, unsigned dark)
{
    static const std::vector<onedim::Surface> kinds = all_surfaces();
    std::vector<onedim::Surface> system(length);
    for (onedim::Surface& surface : system) {
        surface = kinds[random() % kinds.size()];
        if (random() % dark != 0)
            surface.emission = onedim::Intensity::none;
    }
    return system;
}

/// Parses systems from their notation.
[[nodiscard]] inline onedim::Systems systems_of(const std::vector<std::string>& lines)
{
    onedim::Systems systems;
    for (const std::string& line : lines)
        REQUIRE(!read_system(line, systems));
    return systems;
}

/// Every solver; the bit-sliced solver on every instruction set of this machine.
[[nodiscard]] inline std::vector<onedim::SolveOptions> all_solvers()
{
    std::vector<onedim::SolveOptions> solvers{{onedim::Solver::scalar, "auto"},
                                              {onedim::Solver::linear, "auto"}};
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            solvers.push_back({onedim::Solver::bitsliced, isa.name});
    return solvers;
}

/// Checks that every solver gives these answers, with one comparison per solver.
inline void check_all_solvers(const onedim::Systems& systems,
                              const std::vector<onedim::Intensity>& expected)
{
    for (const onedim::SolveOptions& options : all_solvers()) {
        INFO("solver " << static_cast<int>(options.solver) << " on " << options.isa);
        CHECK((solve(systems, options) == expected));
    }
}

}  // namespace packtrace::test
