#include "catch.hpp"
#include "onedim/solvers.hpp"
#include "onedim_brute_force.hpp"
#include "onedim_systems.hpp"
#include <packtrace/onedim.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <random>

namespace packtrace::onedim {
namespace {

using test::BruteForce;

// Solves by brute force, and then by every solver.
void check_systems(const Systems& systems)
{
    std::vector<Intensity> expected;
    std::size_t without_least = 0;
    for (std::size_t k = 0; k < systems.size(); ++k) {
        const BruteForce solutions(systems[k]);
        without_least += solutions.has_least_solution() ? 0u : 1u;
        expected.push_back(solutions.darkest());
    }
    CHECK(without_least == 0);
    test::check_all_solvers(systems, expected);
}

}  // namespace

TEST_CASE("brute force finds the tabulated least and greatest answers", "[onedim_brute]")
{
    std::ifstream table(PACKTRACE_SOURCE_DIR "/tests/data/onedim/exhaustive_n0to2.tsv");
    int lines = 0;
    int differ = 0;
    for (std::string line; std::getline(table, line);) {
        if (line.starts_with('#'))
            continue;
        const std::size_t tab = line.find('\t');
        const Systems one = test::systems_of({line.substr(0, tab)});
        const BruteForce solutions(one[0]);
        const std::string answer = std::string(to_text(solutions.darkest(), Notation::compact)) +
                                   '\t' +
                                   std::string(to_text(solutions.brightest(), Notation::compact));
        differ += answer == line.substr(tab + 1) ? 0 : 1;
        ++lines;
    }
    CHECK(lines == 2971);
    CHECK(differ == 0);
}

TEST_CASE("every system of at most two surfaces has a least solution, and all solvers find it",
          "[onedim_brute]")
{
    const std::vector<Surface> kinds = test::all_surfaces();
    Systems systems;
    systems.push_back({});
    for (const Surface& first : kinds) {
        systems.push_back(std::array{first});
        for (const Surface& second : kinds)
            systems.push_back(std::array{first, second});
    }
    check_systems(systems);
}

TEST_CASE("every system of three surfaces has a least solution, and all solvers find it",
          "[onedim_brute][slow]")
{
    const std::vector<Surface> kinds = test::all_surfaces();
    Systems systems;
    for (const Surface& first : kinds)
        for (const Surface& second : kinds)
            for (const Surface& third : kinds)
                systems.push_back(std::array{first, second, third});
    check_systems(systems);

    Rays rays;
    std::size_t most_sweeps = 0;
    for (std::size_t k = 0; k < systems.size(); ++k)
        most_sweeps = std::max(most_sweeps, iterate(systems[k], rays));
    CHECK(most_sweeps == 4);
}

TEST_CASE("systems of four surfaces have a least solution, and all solvers find it",
          "[onedim_brute]")
{
    std::mt19937 random(4);
    Systems systems;
    for (unsigned k = 0; k < 3000; ++k)
        systems.push_back(test::random_system(random, 4, 1 + k % 4));
    check_systems(systems);
}

}  // namespace packtrace::onedim
