// Reads the two notations of a system. Their readers append to `surfaces` and throw SyntaxError.
#include <packtrace/onedim.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace packtrace::onedim {
namespace {

std::string found(std::string_view rest)
{
    if (rest.empty())
        return "the end of the line";
    const auto byte = static_cast<unsigned char>(rest.front());
    if (byte > 0x20 && byte < 0x7f)
        return std::string("'") + rest.front() + "'";
    constexpr std::string_view digits = "0123456789abcdef";
    return std::string("byte 0x") + digits[byte >> 4] + digits[byte & 15];
}

/// A position on a line. White space before a token is skipped.
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
    [[noreturn]] void fail(std::string_view what)
    {
        skip_space();
        throw SyntaxError{at_ + 1,
                          "expected " + std::string(what) + ", found " + found(line_.substr(at_))};
    }

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

// Note 003's notation.

constexpr std::string_view left = "Inl";
constexpr std::string_view right = "Inr";

// A value may have redundant parentheses, as in `Inr (Inl ())`.
std::size_t open_all(Cursor& cursor)
{
    std::size_t opened = 0;
    while (cursor.accept("("))
        ++opened;
    return opened;
}

void close_all(Cursor& cursor, std::size_t opened)
{
    for (; opened > 0; --opened)
        cursor.expect(")", "')'");
}

void read_unit(Cursor& cursor)
{
    cursor.expect("(", "'()'");
    cursor.expect(")", "')' of '()'");
}

Direction read_direction(Cursor& cursor)
{
    const std::size_t opened = open_all(cursor);
    const bool away = cursor.accept(right);
    if (!away)
        cursor.expect(left, "a direction, Inl () or Inr ()");
    read_unit(cursor);
    close_all(cursor, opened);
    return away ? Direction::away : Direction::towards;
}

Intensity read_nested_intensity(Cursor& cursor, const char* name)
{
    int rights = 0;
    std::size_t opened = open_all(cursor);
    for (; rights < 2 && cursor.accept(right); ++rights)
        opened += open_all(cursor);
    if (!cursor.accept(left))
        cursor.fail(std::string(rights < 2 ? "Inl or Inr" : "Inl after two Inr") + " of the " +
                    name);
    read_unit(cursor);
    close_all(cursor, opened);
    return static_cast<Intensity>(rights);
}

// (D, (R, (T, E)))
Surface read_surface(Cursor& cursor)
{
    Surface surface;
    cursor.expect("(", "'(' of a surface");
    surface.direction = read_direction(cursor);
    cursor.expect(",", "',' after the direction");
    cursor.expect("(", "'(' before the reflectance");
    surface.reflectance = read_nested_intensity(cursor, "reflectance");
    cursor.expect(",", "',' after the reflectance");
    cursor.expect("(", "'(' before the translucence");
    surface.translucence = read_nested_intensity(cursor, "translucence");
    cursor.expect(",", "',' after the translucence");
    surface.emission = read_nested_intensity(cursor, "emission");
    cursor.expect(")", "')' after the emission");
    cursor.expect(")", "')' after the pair of translucence and emission");
    cursor.expect(")", "')' of the surface");
    return surface;
}

/// `Inl((D, (R, (T, E))), Inl(…, … Inr()))`, as in note 003. A list may be nested as deep as memory
/// allows: open pairs are counted, without recursion.
void read_note(Cursor& cursor, std::vector<Surface>& surfaces)
{
    std::size_t open_pairs = 0;
    for (; cursor.accept(left); ++open_pairs) {
        cursor.expect("(", "'(' of a surface and the rest of the list");
        surfaces.push_back(read_surface(cursor));
        cursor.expect(",", "',' between a surface and the rest of the list");
    }
    cursor.expect(right, "Inl of one more surface or Inr () of the list's end");
    read_unit(cursor);
    for (; open_pairs > 0; --open_pairs)
        if (!cursor.accept(")"))
            cursor.fail("')', " + std::to_string(open_pairs) + " more to close the list");
}

// The compact notation.

constexpr std::uint8_t unknown = 3;

// A table, because a chain of comparisons would be mispredicted at every other letter.
constexpr std::array<std::uint8_t, 256> intensity_of_letter = [] {
    std::array<std::uint8_t, 256> table{};
    table.fill(unknown);
    table['N'] = 0;
    table['M'] = 1;
    table['A'] = 2;
    return table;
}();

Intensity read_intensity(Cursor& cursor, const char* name)
{
    const std::uint8_t value = intensity_of_letter[static_cast<unsigned char>(cursor.peek())];
    if (value == unknown)
        cursor.fail(std::string("N, M or A for the ") + name);
    cursor.step();
    return static_cast<Intensity>(value);
}

/// `T:MAN A:NNA`: direction, reflectance, translucence, emission by their first letters.
void read_compact(Cursor& cursor, std::vector<Surface>& surfaces)
{
    for (char letter = cursor.peek(); letter != '\0'; letter = cursor.peek()) {
        if (letter != 'T' && letter != 'A')
            cursor.fail("a surface's direction, T or A");
        cursor.step();
        if (cursor.peek() == ':')
            cursor.step();
        Surface surface;
        surface.direction = letter == 'T' ? Direction::towards : Direction::away;
        surface.reflectance = read_intensity(cursor, "reflectance");
        surface.translucence = read_intensity(cursor, "translucence");
        surface.emission = read_intensity(cursor, "emission");
        surfaces.push_back(surface);
    }
}

}  // namespace

// Only the note's notation begins with an I.
std::optional<SyntaxError> read_system(std::string_view line, Systems& systems)
{
    const std::size_t before = systems.surfaces.size();
    Cursor cursor(line);
    try {
        if (cursor.peek() == 'I')
            read_note(cursor, systems.surfaces);
        else
            read_compact(cursor, systems.surfaces);
        cursor.expect_end();
    } catch (const SyntaxError& error) {
        systems.surfaces.resize(before);
        return error;
    }
    systems.ends.push_back(systems.surfaces.size());
    return std::nullopt;
}

}  // namespace packtrace::onedim
