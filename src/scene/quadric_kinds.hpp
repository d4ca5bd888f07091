#pragma once

#include <array>
#include <span>
#include <string_view>

#include <packtrace/surface.hpp>

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
