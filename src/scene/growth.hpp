#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <packtrace/scene.hpp>

namespace packtrace::language {

/// Colours that may grow beyond single precision where factors are above 1: each reflection and
/// refraction multiplies by them, and so does each object that a transparent shadow passes.
struct Growth {
    std::size_t object;  ///< the one that multiplies most
    std::string message;
};

/// Nothing where no colour can, which no factor at or below 1 in sum can make it.
[[nodiscard]] std::optional<Growth> find_growth(const Scene& scene);

}  // namespace packtrace::language
