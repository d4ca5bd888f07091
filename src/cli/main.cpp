#include <exception>
#include <iostream>

#include "cli/command.hpp"

namespace packtrace::cli {
namespace {

// CLI11 prints help and version itself; a wrong use becomes one line.
int report_parse_end(const CLI::App& app, const CLI::ParseError& end)
{
    if (end.get_exit_code() == 0)
        return app.exit(end);
    std::cerr << "packtrace: " << end.what() << "; see packtrace --help\n";
    return exit_usage;
}

int run(int argc, char** argv)
{
    CLI::App app{"packtrace: a SIMD ray-packet tracer for spheres, planes and quadrics"};
    app.set_version_flag("--version", "packtrace " PACKTRACE_VERSION);
    app.require_subcommand(1);
    add_compare(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& end) {
        return report_parse_end(app, end);
    } catch (const Failed&) {
        return exit_failed;
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return exit_failed;
    }
    return exit_ok;
}

}  // namespace
}  // namespace packtrace::cli

int main(int argc, char** argv)
{
    return packtrace::cli::run(argc, argv);
}
