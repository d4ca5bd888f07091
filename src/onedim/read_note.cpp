#include <string>
#include <string_view>

#include "onedim/notation.hpp"

namespace packtrace::onedim {
namespace {

constexpr std::string_view left = "Inl";
constexpr std::string_view right = "Inr";

// A value's parentheses may be doubled, as in `Inr (Inl ())`.
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

}  // namespace

// A list may be nested as deep as memory allows: its open pairs are counted, not recursed into.
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

}  // namespace packtrace::onedim
