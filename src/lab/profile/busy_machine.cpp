#include "core/text.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/profile/profile_steps.hpp"

#include <cmath>

namespace packtrace {
namespace {

// The share of a frame by which times may vary, and of a whole by which the sum of its parts may
// differ. On an idle machine both are below a third of it.
constexpr double busy_tolerance = 0.1;

std::string percent_text(double share)
{
    return fixed(100.0 * share, 0) + " %";
}

bool differs_from_whole(double part, double whole)
{
    return !(std::abs(part / whole - 1.0) <= busy_tolerance);
}

// The names of generations and what-if rows whose differences vary too much.
std::string doubtful_rows(const Profile& profile)
{
    std::vector<std::string> names;
    for (const ProfileGeneration& generation : profile.generations)
        if (generation.spread > busy_tolerance * profile.frame)
            names.push_back("depth " + std::to_string(generation.depth));
    for (const ProfileWhatIf& row : profile.what_if)
        if (row.spread > busy_tolerance * profile.frame)
            names.push_back(row.name);
    return joined(names);
}

}  // namespace

std::vector<std::string> busy_lines(const Profile& profile)
{
    std::vector<std::string> lines;
    if (!(profile.frame_spread <= busy_tolerance))
        lines.push_back("the frame: its times vary by " + percent_text(profile.frame_spread) +
                        " of their median");
    if (const std::string rows = doubtful_rows(profile); !rows.empty())
        lines.push_back("what these rows differ by: " + rows +
                        "; from turn to turn that varies by more than " +
                        percent_text(busy_tolerance) + " of a frame");
    if (const double sum = sum_of_seconds(profile.stages); differs_from_whole(sum, profile.whole))
        lines.push_back("the stages: they sum to " + percent_text(sum / profile.whole) +
                        " of the whole way");
    const KernelProfile& kernels = profile.kernels;
    if (differs_from_whole(kernels.clocked, kernels.observed))
        lines.push_back("what the clock adds: frames with it take " +
                        percent_text(kernels.clocked / kernels.observed) + " of those without");
    if (const double sum = sum_of_seconds(kernels.stages); differs_from_whole(sum, kernels.clocked))
        lines.push_back("the stages in the kernels: they sum to " +
                        percent_text(sum / kernels.clocked) + " of the clocked frame");
    return lines;
}

}  // namespace packtrace
