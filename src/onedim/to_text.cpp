#include <packtrace/onedim.hpp>

#include <array>

namespace packtrace::onedim {
namespace {

using Spelling = std::array<std::string_view, 3>;

constexpr Spelling note_values{"Inl ()", "Inr Inl ()", "Inr Inr Inl ()"};
constexpr Spelling letters{"N", "M", "A"};
constexpr Spelling words{"None", "Medium", "All"};

const Spelling& spelling(Notation notation)
{
    switch (notation) {
        case Notation::note:
            return note_values;
        case Notation::compact:
            return letters;
        case Notation::words:
            break;
    }
    return words;
}

void append_note(const Surface& surface, std::string& text)
{
    text += surface.direction == Direction::towards ? "Inl((Inl (), (" : "Inl((Inr (), (";
    text += to_text(surface.reflectance, Notation::note);
    text += ", (";
    text += to_text(surface.translucence, Notation::note);
    text += ", ";
    text += to_text(surface.emission, Notation::note);
    text += "))), ";
}

void append_compact(const Surface& surface, std::string& text)
{
    if (!text.empty())
        text += ' ';
    text += surface.direction == Direction::towards ? "T:" : "A:";
    text += to_text(surface.reflectance, Notation::compact);
    text += to_text(surface.translucence, Notation::compact);
    text += to_text(surface.emission, Notation::compact);
}

}  // namespace

std::string_view to_text(Intensity value, Notation notation)
{
    return spelling(notation)[static_cast<std::size_t>(value)];
}

std::string to_text(std::span<const Surface> system, Notation notation)
{
    std::string text;
    const bool note = notation == Notation::note;
    for (const Surface& surface : system)
        note ? append_note(surface, text) : append_compact(surface, text);
    if (note)
        text += "Inr()" + std::string(system.size(), ')');
    return text;
}

}  // namespace packtrace::onedim
