#pragma once

#include <packtrace/onedim.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace packtrace::onedim {

/// A place on a line; white space before a token does not count.
class Cursor {
public:
    explicit Cursor(std::string_view line) : line_(line)
    {
    }

    /// The next character, or 0 at the end of the line.
    [[nodiscard]] char peek()
    {
        skip_space();
        return at_ < line_.size() ? line_[at_] : '\0';
    }

    /// Steps over the character that peek() has shown.
    void step()
    {
        ++at_;
    }

    /// Steps over `token` if it comes next.
    [[nodiscard]] bool accept(std::string_view token)
    {
        skip_space();
        if (!line_.substr(at_).starts_with(token))
            return false;
        at_ += token.size();
        return true;
    }

    /// Steps over `token`, or throws SyntaxError: it was expected as `what`.
    void expect(std::string_view token, std::string_view what)
    {
        if (!accept(token))
            fail(what);
    }

    void expect_end()
    {
        skip_space();
        if (at_ < line_.size())
            fail("the end of the line");
    }

    /// Throws SyntaxError: `what` was expected here.
    [[noreturn]] void fail(std::string_view what);

private:
    void skip_space()
    {
        while (at_ < line_.size() && is_space(line_[at_]))
            ++at_;
    }
    static constexpr bool is_space(char c)
    {
        return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
    }

    std::string_view line_;
    std::size_t at_ = 0;
};

}  // namespace packtrace::onedim
