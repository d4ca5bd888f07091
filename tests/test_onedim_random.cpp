#include "catch.hpp"
#include "onedim/solvers.hpp"
#include "onedim_systems.hpp"
#include <packtrace/onedim.hpp>

#include <algorithm>
#include <random>

namespace packtrace::onedim {
namespace {

void check_solvers_agree(const Systems& systems)
{
    test::check_all_solvers(systems, solve(systems, {Solver::scalar, "auto"}));
}

}  // namespace

TEST_CASE("all solvers agree on a hundred thousand random systems", "[onedim_random]")
{
    std::mt19937 random(8);
    Systems systems;
    for (unsigned k = 0; k < 100'000; ++k) {
        const std::size_t length = random() % 201;
        systems.push_back(test::random_system(random, length, 1 + k % 40));
    }
    const std::vector<Intensity> answers = solve(systems, {Solver::scalar, "auto"});
    for (const Intensity value : {Intensity::none, Intensity::medium, Intensity::all})
        CHECK(std::count(answers.begin(), answers.end(), value) > 1000);
    test::check_all_solvers(systems, answers);
}

TEST_CASE("all solvers agree on any number of systems of any length", "[onedim_random]")
{
    // Numbers close to the sizes of a word, of a run of surfaces and of the groups of every
    // register.
    std::mt19937 random(9);
    for (const std::size_t count : {1u, 2u, 63u, 64u, 65u, 127u, 129u, 255u, 257u, 511u, 513u}) {
        Systems systems;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t around = 8 * (random() % 18);
            systems.push_back(test::random_system(random, around + random() % 3, 4));
        }
        check_solvers_agree(systems);
    }
}

TEST_CASE("a very long system among short ones is solved", "[onedim_random]")
{
    std::mt19937 random(10);
    Systems systems;
    for (const std::size_t length : {3u, 100'000u, 0u, 70u, 9'001u, 8'200u})
        systems.push_back(test::random_system(random, length, 1000));
    check_solvers_agree(systems);
}

TEST_CASE("iteration ends within its bound, in practice after four sweeps", "[onedim_random]")
{
    std::mt19937 random(11);
    Rays rays;
    std::size_t most = 0;
    for (unsigned k = 0; k < 100'000; ++k) {
        const std::size_t length = random() % 30;
        const std::size_t sweeps = iterate(test::random_system(random, length, 1 + k % 10), rays);
        REQUIRE(sweeps <= 4 * length + 1);
        most = std::max(most, sweeps);
    }
    CHECK(most == 4);
}

}  // namespace packtrace::onedim
