#include <packtrace/isa.hpp>
#include <packtrace/onedim.hpp>
#include "dispatch/kernels.hpp"
#include "onedim/solvers.hpp"

#include <span>
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

}  // namespace

Intensity solve(std::span<const Surface> system)
{
    return solve_linear(system);
}

std::vector<Intensity> solve(const Systems& systems, const SolveOptions& options)
{
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
