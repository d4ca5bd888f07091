#pragma once

#include <packtrace/scene.hpp>

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

// The words of the scene language that stand for values of enumerations and for kinds of surfaces,
// each with what it stands for.
namespace packtrace {

/// A quadric kind that has a name and coefficients of its own.
struct QuadricKindInfo {
    QuadricKind kind;
    std::string_view name;  ///< the scene language's
    std::array<double, 10> coefficients;
    std::string_view equation;  ///< for readers
};

/// Every kind but `general`.
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

/// A word is taken for either value by more than one spelling; the first of each is written.
constexpr std::array<Spelling<bool>, 4> spellings(bool)
{
    return {{{false, "no"}, {true, "yes"}, {false, "false"}, {true, "true"}}};
}

[[nodiscard]] std::vector<Spelling<QuadricKind>> spellings(QuadricKind);

/// The word that is written for a value; empty for none of the enumeration.
template <class Enum>
[[nodiscard]] constexpr std::string_view word_of(Enum value)
{
    for (const Spelling<Enum>& spelling : spellings(value))
        if (spelling.value == value)
            return spelling.word;
    return {};
}

/// The value that a word stands for.
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
    Surface blank;  ///< of the kind, with the coefficients that the kind has of its own
    std::string_view equation;
};

/// All kinds, in the order in which they are listed.
[[nodiscard]] std::span<const SurfaceWord> surface_words();
/// That of a general quadric for a kind that does not exist.
[[nodiscard]] const SurfaceWord& word_of(const Surface& surface);

}  // namespace packtrace::language
