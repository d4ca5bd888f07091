#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace packtrace::bench {

/// Which numbers an option takes.
template <class Number>
struct Range {
    Number low;
    Number high;
    int step = 1;  ///< whole numbers are multiples of it
};

/// A program's command line, and how it ends. CLI11 stays behind it: it leaves a hundred kilobytes
/// of code in each source that includes it.
class Program {
public:
    Program(std::string name, const std::string& purpose);
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    ~Program();

    // What the command line sets; a value keeps what it has where the option is not given. Names
    // without dashes are those of arguments that must be given, in their order. Lists are parted by
    // commas. `Number` is int or double.
    void flag(const std::string& name, bool& value, const std::string& help);
    void text(const std::string& name, std::string& value, const std::string& help,
              bool required = false);
    /// Of no `allowed` words all are.
    void words(const std::string& name, std::vector<std::string>& value, const std::string& help,
               const std::vector<std::string>& allowed = {});
    template <class Number>
    void number(const std::string& name, Number& value, const Range<Number>& range,
                const std::string& help);
    template <class Number>
    void numbers(const std::string& name, std::vector<Number>& value, const Range<Number>& range,
                 const std::string& help);

    /// One of the things that a program does, with options of its own; one of them must be given.
    Program& command(const std::string& name, const std::string& purpose,
                     std::function<void()> work);

    /// Parses the arguments and does the work, of a command's its own; returns what main() does:
    /// 2 for arguments that are wrong, 1 where the work throws, which is printed behind the name.
    [[nodiscard]] int run(int argc, const char* const* argv, std::function<void()> work = {});

    /// The name and the arguments that run() was given.
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
