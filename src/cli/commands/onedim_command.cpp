#include <packtrace/onedim.hpp>

#include <cerrno>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/validators.hpp"
#include "core/read_file.hpp"
#include "scene/language/quote.hpp"

namespace packtrace::cli {
namespace {

using onedim::Notation;
using onedim::Solver;

const std::map<std::string, Solver> solvers{
    {"scalar", Solver::scalar}, {"linear", Solver::linear}, {"bitsliced", Solver::bitsliced}};
const std::map<std::string, Notation> notations{
    {"words", Notation::words}, {"note", Notation::note}, {"compact", Notation::compact}};

struct OnedimArguments {
    std::string file;
    std::string solver = "bitsliced";
    IsaArguments isa;
    std::string output = "words";
    bool keep_going = false;
};

// Throws CLI::ValidationError for options that contradict each other.
onedim::SolveOptions solve_options(const OnedimArguments& arguments)
{
    const Solver solver = solvers.at(arguments.solver);
    if (solver == Solver::bitsliced)
        return {solver, chosen_isa(arguments.isa).name};
    if (arguments.isa.isa || arguments.isa.width)
        throw CLI::ValidationError(std::string(arguments.isa.isa ? "--isa" : "--width") +
                                   ": only the bitsliced solver has one; leave it out");
    return {solver, "auto"};
}

// Answers lines in blocks, so that memory does not grow with the file.
class LineAnswerer {
public:
    explicit LineAnswerer(const OnedimArguments& arguments)
        : source_(arguments.file == "-" ? "<stdin>" : arguments.file),
          options_(solve_options(arguments)),
          output_(notations.at(arguments.output)),
          keep_going_(arguments.keep_going)
    {
    }

    // Whether the line is well-formed.
    bool add(const std::string& line)
    {
        ++line_number_;
        if (is_comment(line))
            return true;
        const auto error = onedim::read_system(line, systems_);
        if (error)
            report(*error);
        if (systems_.size() >= most_systems || systems_.surfaces.size() >= most_surfaces)
            flush();
        return !error;
    }

    // Prints an answer for every line since the last time, ? for a malformed one.
    void flush()
    {
        const std::vector<onedim::Intensity> answers = solve(systems_, options_);
        std::string text;
        auto malformed = malformed_.begin();
        for (std::size_t k = 0; k < answers.size(); ++k) {
            const bool known = malformed == malformed_.end() || *malformed != k;
            text += known ? to_text(answers[k], output_) : "?";
            text += '\n';
            if (!known)
                ++malformed;
        }
        if (!std::cout.write(text.data(), static_cast<std::streamsize>(text.size())).flush())
            throw std::runtime_error("can't write the answers to standard output");
        systems_.clear();
        malformed_.clear();
    }

private:
    static constexpr std::size_t most_systems = 1 << 14;
    static constexpr std::size_t most_surfaces = 1 << 22;

    static bool is_comment(const std::string& line)
    {
        const std::size_t first = line.find_first_not_of(" \t");
        return first != std::string::npos && line[first] == '#';
    }

    void report(const onedim::SyntaxError& error)
    {
        const std::string message = source_ + ":" + std::to_string(line_number_) + ":" +
                                    std::to_string(error.column) + ": " + error.message;
        if (!keep_going_) {
            flush();
            throw std::runtime_error(message);
        }
        std::cerr << language::escape(message) << '\n';
        malformed_.push_back(systems_.size());
        systems_.push_back({});
    }

    std::string source_;
    onedim::SolveOptions options_;
    Notation output_;
    bool keep_going_;
    onedim::Systems systems_;
    std::vector<std::size_t> malformed_;  ///< numbers of the block's systems that stand for a line
    std::size_t line_number_ = 0;
};

void answer_all(std::istream& in, const OnedimArguments& arguments)
{
    LineAnswerer answerer(arguments);
    bool all_well = true;
    for (std::string line; std::getline(in, line);)
        all_well = answerer.add(line) && all_well;
    const int read_error = in.bad() ? errno : 0;
    answerer.flush();
    if (read_error != 0)
        throw FileError(arguments.file, "can't read", read_error);
    if (!all_well)
        throw Failed{};
}

void run_onedim(const OnedimArguments& arguments)
{
    if (arguments.file == "-") {
        std::ios::sync_with_stdio(false);
        answer_all(std::cin, arguments);
        return;
    }
    std::ifstream in(arguments.file);
    if (!in)
        throw FileError(arguments.file, "can't read", errno);
    answer_all(in, arguments);
}

}  // namespace

void add_onedim(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "onedim", "Solve systems of the one-dimensional ray tracer, one on each line");
    const auto arguments = std::make_shared<OnedimArguments>();
    command->add_option("FILE", arguments->file, "Systems, or - for standard input")->required();
    command->add_option("--solver", arguments->solver, "How to solve them (default bitsliced)")
        ->check(one_of({"scalar", "linear", "bitsliced"}))
        ->type_name("scalar|linear|bitsliced");
    add_isa_and_width(*command, arguments->isa);
    command->add_option("--output", arguments->output, "How to write answers (default words)")
        ->check(one_of({"words", "compact", "note"}))
        ->type_name("words|compact|note");
    command->add_flag("--keep-going", arguments->keep_going,
                      "Answer ? for a malformed line and go on; exit 1 at the end");
    command->callback([arguments] { run_onedim(*arguments); });
}

}  // namespace packtrace::cli
