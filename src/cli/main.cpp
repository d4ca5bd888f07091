#include <exception>
#include <iostream>
#include <new>

#include "cli/command.hpp"
#include "cli/usage_error.hpp"

namespace packtrace::cli {
namespace {

// CLI11 prints help and version itself; a wrong use becomes one line.
int report_parse_end(const CLI::App& app, const CLI::ParseError& end, int argc, char** argv)
{
    if (end.get_exit_code() == 0)
        return app.exit(end);
    std::cerr << usage_error(app, end, argc, argv) << '\n';
    return exit_usage;
}

int run(int argc, char** argv)
{
    CLI::App app{"packtrace: a SIMD ray-packet tracer for spheres, planes and quadrics"};
    app.set_version_flag("--version", "packtrace " PACKTRACE_VERSION);
    // Not required here: a mistyped one would be called missing.
    app.require_subcommand(0, 1);
    add_render(app);
    add_compare(app);
    add_report(app);
    add_profile(app);
    add_bench(app);
    add_explain(app);
    add_generate(app);
    add_info(app);
    add_intersect(app);
    add_demo(app);
    add_onedim(app);
    add_stress(app);
    try {
        app.parse(argc, argv);
        if (app.get_subcommands().empty())
            throw CLI::RequiredError::Subcommand(1);
    } catch (const CLI::ParseError& end) {
        return report_parse_end(app, end, argc, argv);
    } catch (const Failed& failed) {
        return failed.exit_code;
    } catch (const std::bad_alloc&) {
        std::cerr << "packtrace: not enough memory\n";
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
