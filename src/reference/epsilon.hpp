#pragma once

namespace packtrace::reference {

/// How far along a ray its own start is no hit: note 001 and note 004 name this number. Note
/// 001 counts it in lengths of its directions, which are not normalised; the others in units
/// of length.
template <class Real>
inline constexpr Real epsilon = Real(0.001L);

}  // namespace packtrace::reference
