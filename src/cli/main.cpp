#include "cli/command.hpp"
#include "cli/interrupts.hpp"
#include "cli/output/standard_output.hpp"
#include "cli/usage_error.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/version.hpp>

#include <exception>
#include <iostream>
#include <new>

namespace packtrace::cli {
namespace {

// CLI11 prints help and version itself. Wrong use is reported in one line.
int report_parse_end(const CLI::App& app, const CLI::ParseError& end, int argc, char** argv)
{
    if (end.get_exit_code() == 0) {
        const int code = app.exit(end);
        check_standard_output();
        return code;
    }
    std::cerr << language::escape(usage_error(app, end, argc, argv)) << '\n';
    return exit_usage;
}

/// Runs the subcommand. Its exceptions end the program.
int parse_and_run(CLI::App& app, int argc, char** argv)
{
    ask_for_subcommand(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& end) {
        return report_parse_end(app, end, argc, argv);
    }
    check_standard_output();
    return exit_ok;
}

/// Adding the commands allocates, too, so it is inside the handlers of main().
int set_up_and_run(int argc, char** argv)
{
    CLI::App app{"packtrace: a SIMD ray-packet tracer for spheres, planes, quadrics and polygons"};
    app.set_version_flag("--version", "packtrace " PACKTRACE_VERSION_STRING);
    add_render(app);
    add_compare(app);
    add_completion(app);
    add_report(app);
    add_profile(app);
    add_bench(app);
    add_explain(app);
    add_generate(app);
    add_info(app);
    add_intersect(app);
    add_join(app);
    add_demo(app);
    add_onedim(app);
    add_soak(app);
    add_stress(app);
    clean_up_when_interrupted();
    report_size_limits_as_errors();
    return parse_and_run(app, argc, argv);
}

int run(int argc, char** argv)
{
    try {
        return set_up_and_run(argc, argv);
    } catch (const Failed& failed) {
        return failed.exit_code;
    } catch (const std::bad_alloc&) {
        std::cerr << "packtrace: not enough memory\n";
        return exit_failed;
    } catch (const std::exception& error) {
        // escape() makes one line of it, even if names of files have line ends.
        std::cerr << language::escape(error.what()) << '\n';
        return exit_failed;
    }
}

}  // namespace
}  // namespace packtrace::cli

int main(int argc, char** argv)
{
    return packtrace::cli::run(argc, argv);
}
