#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace packtrace::bench {

/// The range of an option's numbers.
template <class Number>
struct Range {
    Number low;
    Number high;
    int step = 1;  ///< whole numbers must be multiples of it
};

/// Whether an option must be given.
enum class Need { optional, required };

/// A program's command line and exit codes. It hides CLI11, which adds a hundred kilobytes of code
/// to each source that includes it.
class Program {
public:
    Program(std::string name, const std::string& purpose);
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    ~Program();

    // Options. A value is not changed if its option is not given. Names without dashes are
    // positional arguments, which must be given in order. Lists are separated by commas. `Number`
    // is int or double.
    void flag(const std::string& name, bool& value, const std::string& help);
    void text(const std::string& name, std::string& value, const std::string& help,
              Need need = Need::optional);
    /// Empty `allowed` allows all words.
    void words(const std::string& name, std::vector<std::string>& value, const std::string& help,
               const std::vector<std::string>& allowed = {});
    template <class Number>
    void number(const std::string& name, Number& value, const Range<Number>& range,
                const std::string& help);
    template <class Number>
    void numbers(const std::string& name, std::vector<Number>& value, const Range<Number>& range,
                 const std::string& help);

    /// Adds a subcommand with its own options. If there are subcommands, one must be given.
    Program& command(const std::string& name, const std::string& purpose,
                     std::function<void()> work);

    /// Parses the arguments, and does the work or that of the subcommand. Returns the exit code: 2
    /// for wrong arguments, 1 if the work throws; then it prints the error.
    [[nodiscard]] int run(int argc, const char* const* argv, std::function<void()> work = {});

    /// The name and the arguments of run().
    [[nodiscard]] const std::string& command_line() const;

private:
    struct Parser;
    Program(std::string name, std::unique_ptr<Parser> parser);

    std::string name_;
    std::string command_line_;
    std::function<void()> work_;
    std::unique_ptr<Parser> parser_;
    std::vector<std::unique_ptr<Program>> commands_;
};

}  // namespace packtrace::bench
