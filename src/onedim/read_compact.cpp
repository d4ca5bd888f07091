#include <array>
#include <cstdint>
#include <string>

#include "onedim/notation.hpp"

namespace packtrace::onedim {
namespace {

constexpr std::uint8_t unknown = 3;

// A table and not a chain of comparisons, which would be mispredicted at every other letter.
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

}  // namespace

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

}  // namespace packtrace::onedim
