#pragma once

#include <packtrace/onedim.hpp>

#include <vector>

#include "onedim/cursor.hpp"

// The two ways to write a system. Each reader appends to `surfaces` and throws SyntaxError.
namespace packtrace::onedim {

/// `Inl((D, (R, (T, E))), Inl(…, … Inr()))`, as note 003 has it.
void read_note(Cursor& cursor, std::vector<Surface>& surfaces);

/// `T:MAN A:NNA`: direction, reflectance, translucence, emission by their first letters.
void read_compact(Cursor& cursor, std::vector<Surface>& surfaces);

}  // namespace packtrace::onedim
