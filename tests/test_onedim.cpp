#include "catch.hpp"
#include "onedim/intensity.hpp"
#include "onedim/solvers.hpp"
#include "onedim_systems.hpp"
#include <packtrace/onedim.hpp>

#include <fstream>
#include <stdexcept>

namespace packtrace::onedim {
namespace {

constexpr Intensity N = Intensity::none;
constexpr Intensity M = Intensity::medium;
constexpr Intensity A = Intensity::all;

void check(const std::vector<std::string>& lines, const std::vector<Intensity>& expected)
{
    test::check_all_solvers(test::systems_of(lines), expected);
}

}  // namespace

TEST_CASE("the sum is as in the note's table", "[onedim]")
{
    CHECK((N + N == N && N + M == M && N + A == A));
    CHECK((M + N == M && M + M == A && M + A == A));
    CHECK((A + N == A && A + M == A && A + A == A));
}

TEST_CASE("the product is as in the note's table", "[onedim]")
{
    CHECK((N * N == N && N * M == N && N * A == N));
    CHECK((M * N == N && M * M == M && M * A == M));
    CHECK((A * N == N && A * M == M && A * A == A));
}

TEST_CASE("empty space is dark", "[onedim]")
{
    check({""}, {N});
}

TEST_CASE("the eye sees the emission of a single surface that faces it", "[onedim]")
{
    check({"T:AAN", "T:AAM", "T:NNA", "A:AAN", "A:AAM", "A:NNA"}, {N, M, A, N, N, N});
}

TEST_CASE("a surface dims what shines through it", "[onedim]")
{
    check({"T:NAN T:NNM", "T:NMN T:NNA", "T:NNN T:NNA", "T:AAN T:NNA"}, {M, M, N, A});
}

TEST_CASE("two values Medium add up to All", "[onedim]")
{
    check({"T:NMM T:NNM", "T:NAM T:NNM"}, {A, A});
}

TEST_CASE("a surface that faces away lets the eye see through it", "[onedim]")
{
    check({"A:NNN T:NNM", "A:AAA T:NNN"}, {M, N});
}

TEST_CASE("light between two mirrors grows to the least solution", "[onedim]")
{
    // R1 = R L1 + E of the first surface, L1 = R R1 of the second, L0 = L1.
    check({"A:ANM T:ANN", "A:MNM T:MNN", "A:NNM T:ANN", "A:ANA T:MNN"}, {A, M, M, M});
}

TEST_CASE("mirrors without a light stay dark", "[onedim]")
{
    // L1 = R1 = All also solves the equations, but is not the least solution.
    check({"A:ANN T:ANN", "A:AAN T:AAN"}, {N, N});
}

TEST_CASE("the least solution has every ray, not only the one at the eye", "[onedim]")
{
    const Systems systems = test::systems_of({"A:MNM T:MNN"});
    Rays rays;
    const std::size_t sweeps = iterate(systems[0], rays);
    CHECK((rays.left == std::vector{M, M, N}));
    CHECK((rays.right == std::vector{N, A, A}));
    CHECK(sweeps <= 4 * 2 + 1);
}

TEST_CASE("all systems of at most two surfaces give the tabulated answers", "[onedim]")
{
    std::ifstream table(PACKTRACE_SOURCE_DIR "/tests/data/onedim/exhaustive_n0to2.tsv");
    Systems systems;
    std::vector<Intensity> expected;
    for (std::string line; std::getline(table, line);) {
        if (line.starts_with('#'))
            continue;
        const std::size_t tab = line.find('\t');
        REQUIRE(!read_system(line.substr(0, tab), systems));
        expected.push_back(static_cast<Intensity>(std::string("NMA").find(line.at(tab + 1))));
    }
    REQUIRE(systems.size() == 1 + 54 + 54 * 54);
    test::check_all_solvers(systems, expected);
}

TEST_CASE("a system alone has the same solution as among others", "[onedim]")
{
    CHECK((solve(test::systems_of({"A:ANM T:ANN"})[0]) == A));
    CHECK((solve(std::span<const Surface>{}) == N));
}

TEST_CASE("systems that end without a surface are refused", "[onedim]")
{
    onedim::Systems systems;
    systems.ends = {5};
    CHECK_THROWS_AS(onedim::solve(systems), std::invalid_argument);
    systems.surfaces.resize(5);
    systems.ends = {3, 2, 5};
    CHECK_THROWS_AS(onedim::solve(systems), std::invalid_argument);
}

TEST_CASE("an empty list of systems has no answers", "[onedim]")
{
    test::check_all_solvers({}, {});
}

TEST_CASE("an unknown instruction set is refused", "[onedim]")
{
    CHECK_THROWS_AS(solve(Systems{}, {Solver::bitsliced, "mmx"}), std::invalid_argument);
}

}  // namespace packtrace::onedim
