#include "dispatch/kernels.hpp"
#include "onedim/solvers.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/onedim.hpp>

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace packtrace::onedim {
namespace {

void solve_scalar(const Systems& systems, std::span<Intensity> answers)
{
    Rays rays;
    for (std::size_t k = 0; k < systems.size(); ++k) {
        iterate(systems[k], rays);
        answers[k] = rays.left.front();
    }
}

void solve_linear(const Systems& systems, std::span<Intensity> answers)
{
    for (std::size_t k = 0; k < systems.size(); ++k)
        answers[k] = solve_linear(systems[k]);
}

void check(const Systems& systems)
{
    std::size_t end = 0;
    for (const std::size_t next : systems.ends) {
        if (next < end || next > systems.surfaces.size())
            throw std::invalid_argument("a system ends at surface " + std::to_string(next) +
                                        " of " + std::to_string(systems.surfaces.size()) +
                                        ", after one that ends at " + std::to_string(end) +
                                        "; let ends rise, and none be beyond the surfaces");
        end = next;
    }
}

}  // namespace

Intensity solve(std::span<const Surface> system)
{
    return solve_linear(system);
}

std::vector<Intensity> solve(const Systems& systems, const SolveOptions& options)
{
    check(systems);
    std::vector<Intensity> answers(systems.size());
    switch (options.solver) {
        case Solver::scalar:
            solve_scalar(systems, answers);
            break;
        case Solver::linear:
            solve_linear(systems, answers);
            break;
        case Solver::bitsliced:
            solve_bitsliced(systems, kernels_of(choose_isa(options.isa).name).onedim, answers);
            break;
    }
    return answers;
}

}  // namespace packtrace::onedim
