#include "cli/without_study.hpp"

#include "cli/command.hpp"
#include "cli/study/study.hpp"

#include <stdexcept>
#include <string>

// Replaces the commands of src/cli/study in builds without PACKTRACE_BUILD_STUDY.
namespace packtrace::cli {
namespace {

void leave_out(CLI::App& app, const std::string& name)
{
    add_left_out(app, name, [name] { throw std::runtime_error(why_left_out("packtrace", name)); });
}

[[noreturn]] void fail_certainty()
{
    throw std::runtime_error(why_left_out("packtrace", "render --certainty"));
}

}  // namespace

void check_certainty(const RenderArguments&, const RenderOptions&)
{
    fail_certainty();
}

void check_certainty_size(const Scene&)
{
    fail_certainty();
}

std::string write_certainty(const RenderArguments&, const Scene&, const RenderOptions&)
{
    fail_certainty();
}

std::optional<UnsureSample> sample_unsure(const Scene&, const std::string&)
{
    return std::nullopt;
}

std::string join_stress(const std::vector<std::string>&)
{
    throw std::runtime_error(
        "packtrace: this build leaves out parts of 'stress'; type ./run build, which builds all "
        "commands");
}

void add_bench(CLI::App& app)
{
    leave_out(app, "bench");
}

void add_explain(CLI::App& app)
{
    leave_out(app, "explain");
}

void add_profile(CLI::App& app)
{
    leave_out(app, "profile");
}

void add_report(CLI::App& app)
{
    leave_out(app, "report");
}

void add_soak(CLI::App& app)
{
    leave_out(app, "soak");
}

void add_stress(CLI::App& app)
{
    leave_out(app, "stress");
}

}  // namespace packtrace::cli
