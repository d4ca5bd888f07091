#include "program.hpp"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <type_traits>
#include <utility>

namespace packtrace::bench {
namespace {

/// Makes an option required by `need`; positional arguments are always required.
CLI::Option* with_need(CLI::Option* option, Need need = Need::optional)
{
    return option->required(need == Need::required || option->get_positional());
}

template <class Number>
CLI::Validator in_range(const Range<Number>& range)
{
    CLI::Validator validator = CLI::Range(range.low, range.high);
    if constexpr (std::is_same_v<Number, int>)
        if (const int step = range.step; step > 1)
            validator = validator &
                        CLI::Validator(
                            [step](const std::string& text) {
                                return std::stoi(text) % step == 0
                                           ? std::string()
                                           : text + " is no multiple of " + std::to_string(step);
                            },
                            "multiple of " + std::to_string(step));
    return validator;
}

}  // namespace

struct Program::Parser {
    std::unique_ptr<CLI::App> own;  ///< null for a subcommand, which the program's App owns
    CLI::App* app;
};

Program::Program(std::string name, const std::string& purpose)
    : name_(std::move(name)), parser_(std::make_unique<Parser>())
{
    parser_->own = std::make_unique<CLI::App>(purpose, name_);
    parser_->app = parser_->own.get();
}

Program::Program(std::string name, std::unique_ptr<Parser> parser)
    : name_(std::move(name)), parser_(std::move(parser))
{
}

Program::~Program() = default;

void Program::flag(const std::string& name, bool& value, const std::string& help)
{
    parser_->app->add_flag(name, value, help);
}

void Program::text(const std::string& name, std::string& value, const std::string& help, Need need)
{
    with_need(parser_->app->add_option(name, value, help), need);
}

void Program::words(const std::string& name, std::vector<std::string>& value,
                    const std::string& help, const std::vector<std::string>& allowed)
{
    CLI::Option* const option = with_need(parser_->app->add_option(name, value, help));
    if (!allowed.empty())
        option->check(CLI::IsMember(allowed));
    option->delimiter(',');
}

template <class Number>
void Program::number(const std::string& name, Number& value, const Range<Number>& range,
                     const std::string& help)
{
    with_need(parser_->app->add_option(name, value, help))->check(in_range(range));
}

template <class Number>
void Program::numbers(const std::string& name, std::vector<Number>& value,
                      const Range<Number>& range, const std::string& help)
{
    with_need(parser_->app->add_option(name, value, help))->check(in_range(range))->delimiter(',');
}

template void Program::number(const std::string&, int&, const Range<int>&, const std::string&);
template void Program::number(const std::string&, double&, const Range<double>&,
                              const std::string&);
template void Program::numbers(const std::string&, std::vector<int>&, const Range<int>&,
                               const std::string&);
template void Program::numbers(const std::string&, std::vector<double>&, const Range<double>&,
                               const std::string&);

Program& Program::command(const std::string& name, const std::string& purpose,
                          std::function<void()> work)
{
    parser_->app->require_subcommand(1);
    auto parser = std::make_unique<Parser>();
    parser->app = parser_->app->add_subcommand(name, purpose);
    commands_.push_back(std::unique_ptr<Program>(new Program(name, std::move(parser))));
    commands_.back()->work_ = std::move(work);
    return *commands_.back();
}

int Program::run(int argc, const char* const* argv, std::function<void()> work)
{
    command_line_ = name_;
    for (int i = 1; i < argc; ++i)
        command_line_ += std::string(" ") + argv[i];
    try {
        parser_->app->parse(argc, argv);
        if (work)
            work();
        for (const auto& command : commands_)
            if (command->parser_->app->parsed())
                command->work_();
    } catch (const CLI::ParseError& end) {
        return parser_->app->exit(end) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::cerr << name_ << ": " << error.what() << '\n';
        return 1;
    }
    return 0;
}

const std::string& Program::command_line() const
{
    return command_line_;
}

}  // namespace packtrace::bench
