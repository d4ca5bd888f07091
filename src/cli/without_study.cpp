#include <stdexcept>
#include <string>

#include "cli/command.hpp"
#include "cli/study/study.hpp"

// Stands in for the commands of src/lab in programs built without it (PACKTRACE_BUILD_STUDY).
namespace packtrace::cli {
namespace {

void add_left_out(CLI::App& app, const std::string& name)
{
    CLI::App* command = app.add_subcommand(name, "(not in this build; ./run build adds it)");
    command->allow_extras();
    command->callback([name] {
        throw std::runtime_error("packtrace: this build leaves out '" + name +
                                 "'; type ./run build, which builds all commands");
    });
}

[[noreturn]] void fail_certainty()
{
    throw std::runtime_error(
        "packtrace: this build leaves out 'render --certainty'; type ./run "
        "build, which builds all commands");
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
    add_left_out(app, "bench");
}

void add_explain(CLI::App& app)
{
    add_left_out(app, "explain");
}

void add_profile(CLI::App& app)
{
    add_left_out(app, "profile");
}

void add_report(CLI::App& app)
{
    add_left_out(app, "report");
}

void add_soak(CLI::App& app)
{
    add_left_out(app, "soak");
}

void add_stress(CLI::App& app)
{
    add_left_out(app, "stress");
}

}  // namespace packtrace::cli
