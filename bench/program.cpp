#include "program.hpp"

#include <exception>
#include <iostream>

namespace packtrace::bench {

std::string command_line(const std::string& program, int argc, const char* const* argv)
{
    std::string line = program;
    for (int i = 1; i < argc; ++i)
        line += std::string(" ") + argv[i];
    return line;
}

int run_program(CLI::App& app, const std::string& program, int argc, char** argv,
                const std::function<void()>& work)
{
    try {
        app.parse(argc, argv);
        work();
    } catch (const CLI::ParseError& end) {
        return app.exit(end) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::cerr << program << ": " << error.what() << '\n';
        return 1;
    }
    return 0;
}

}  // namespace packtrace::bench
