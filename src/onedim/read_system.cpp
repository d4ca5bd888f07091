#include <packtrace/onedim.hpp>

#include "onedim/notation.hpp"

namespace packtrace::onedim {

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
