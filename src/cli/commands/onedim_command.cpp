#include "cli/command.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/output.hpp"
#include "core/read_file.hpp"
#include "scene/language/quote.hpp"
#include "scene/language/words.hpp"
#include <packtrace/onedim.hpp>

#include <array>
#include <cerrno>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

// Not in an unnamed namespace, because argument-dependent lookup must find them.
namespace packtrace::onedim {

constexpr std::array<language::Spelling<Solver>, 3> spellings(Solver)
{
    return {
        {{Solver::scalar, "scalar"}, {Solver::linear, "linear"}, {Solver::bitsliced, "bitsliced"}}};
}

constexpr std::array<language::Spelling<Notation>, 3> spellings(Notation)
{
    return {{{Notation::words, "words"}, {Notation::compact, "compact"}, {Notation::note, "note"}}};
}

}  // namespace packtrace::onedim

namespace packtrace::cli {
namespace {

using onedim::Notation;
using onedim::Solver;

struct OnedimArguments {
    std::string file;
    std::optional<std::string> solver;
    IsaArguments isa;
    std::optional<std::string> output;
    bool keep_going = false;
};

// Throws CLI::ValidationError for options that contradict each other.
onedim::SolveOptions solve_options(const OnedimArguments& arguments)
{
    const Solver solver = value_or(arguments.solver, Solver::bitsliced);
    if (solver == Solver::bitsliced)
        return {solver, chosen_isa(arguments.isa).name};
    if (arguments.isa.isa || arguments.isa.width)
        throw CLI::ValidationError(std::string(arguments.isa.isa ? "--isa" : "--width") +
                                   ": only the bitsliced solver has one; leave it out");
    return {solver, "auto"};
}

// Solves lines in blocks, so that memory does not grow with the file.
class LineAnswerer {
public:
    explicit LineAnswerer(const OnedimArguments& arguments)
        : source_(arguments.file == "-" ? "<stdin>" : arguments.file),
          options_(solve_options(arguments)),
          notation_(value_or(arguments.output, Notation::words)),
          keep_going_(arguments.keep_going)
    {
    }

    // Returns whether the line is well-formed.
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

    // Prints an answer for every line since the last call, ? for a malformed line.
    void flush()
    {
        const std::vector<onedim::Intensity> answers = solve(systems_, options_);
        std::string text;
        auto malformed = malformed_.begin();
        for (std::size_t k = 0; k < answers.size(); ++k) {
            const bool known = malformed == malformed_.end() || *malformed != k;
            text += known ? to_text(answers[k], notation_) : "?";
            text += '\n';
            if (!known)
                ++malformed;
        }
        output_.write(text);
        output_.flush();
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
    Notation notation_;
    Output output_{"-"};
    bool keep_going_;
    onedim::Systems systems_;
    std::vector<std::size_t> malformed_;  ///< indices of systems that replace malformed lines
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
        throw FileError(arguments.file, FileAction::read, read_error);
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
        throw FileError(arguments.file, FileAction::read, errno);
    answer_all(in, arguments);
}

}  // namespace

void add_onedim(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "onedim", "Solve systems of the one-dimensional ray tracer, one on each line");
    const auto arguments = std::make_shared<OnedimArguments>();
    command->add_option("FILE", arguments->file, "Systems, or - for standard input")
        ->required()
        ->check(file_name());
    add_word_option(*command, "--solver", arguments->solver,
                    "How to solve them (default bitsliced)", words_of<Solver>());
    add_isa_and_width(*command, arguments->isa);
    add_word_option(*command, "--output", arguments->output, "How to write answers (default words)",
                    words_of<Notation>());
    command->add_flag("--keep-going", arguments->keep_going,
                      "Answer ? for a malformed line and go on; exit 1 at the end");
    command->callback([arguments] { run_onedim(*arguments); });
}

}  // namespace packtrace::cli
