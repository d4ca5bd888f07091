#pragma once

#include <packtrace/scene.hpp>

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

// The words of the scene language for values of enumerations and for kinds of surfaces, with their
// meanings.
namespace packtrace {

/// A quadric kind with a name and fixed coefficients.
struct QuadricKindInfo {
    QuadricKind kind;
    std::string_view name;  ///< in the scene language
    std::array<double, 10> coefficients;
    std::string_view equation;  ///< for readers
};

/// All kinds except `general`.
[[nodiscard]] std::span<const QuadricKindInfo> quadric_kinds();

/// The row of a kind; null for `general`.
[[nodiscard]] const QuadricKindInfo* find_quadric_kind(QuadricKind kind);

}  // namespace packtrace

namespace packtrace::language {

template <class Enum>
struct Spelling {
    Enum value;
    std::string_view word;
};

constexpr std::array<Spelling<Illumination>, 5> spellings(Illumination)
{
    return {{{Illumination::scratch, "scratch"},
             {Illumination::sketch, "sketch"},
             {Illumination::whitted, "whitted"},
             {Illumination::shader, "shader"},
             {Illumination::general, "general"}}};
}

constexpr std::array<Spelling<ShadowKind>, 3> spellings(ShadowKind)
{
    return {{{ShadowKind::none, "none"},
             {ShadowKind::opaque, "opaque"},
             {ShadowKind::transparent, "transparent"}}};
}

constexpr std::array<Spelling<DepthLimit>, 2> spellings(DepthLimit)
{
    return {{{DepthLimit::background, "background"}, {DepthLimit::local, "local"}}};
}

constexpr std::array<Spelling<LightType>, 3> spellings(LightType)
{
    return {{{LightType::ambient, "ambient"},
             {LightType::point, "point"},
             {LightType::directional, "directional"}}};
}

/// Each value has two spellings. Both are read; the first is written.
constexpr std::array<Spelling<bool>, 4> spellings(bool)
{
    return {{{false, "no"}, {true, "yes"}, {false, "false"}, {true, "true"}}};
}

[[nodiscard]] std::vector<Spelling<QuadricKind>> spellings(QuadricKind);

/// The word that is written for a value; empty for a value that the enumeration does not have.
template <class Enum>
[[nodiscard]] constexpr std::string_view word_of(Enum value)
{
    for (const Spelling<Enum>& spelling : spellings(value))
        if (spelling.value == value)
            return spelling.word;
    return {};
}

/// The value of a word; not set for an unknown word.
template <class Enum>
[[nodiscard]] constexpr std::optional<Enum> find_word(std::string_view word)
{
    for (const Spelling<Enum>& spelling : spellings(Enum{}))
        if (spelling.word == word)
            return spelling.value;
    return std::nullopt;
}

/// `word { … }` is an object with a surface of this kind.
struct SurfaceWord {
    std::string_view word;
    Surface blank;  ///< a surface of this kind, with the kind's coefficients
    std::string_view equation;
};

/// All kinds, in the order in which they are listed.
[[nodiscard]] std::span<const SurfaceWord> surface_words();
/// The word of a surface. For a kind that does not exist, that of a general quadric.
[[nodiscard]] const SurfaceWord& word_of(const Surface& surface);

}  // namespace packtrace::language
