#pragma once

// How large and how small the numbers of a scene may be, so that single precision can work with
// them (docs/scene.md, Ranges; tests/test_validate.cpp looks for NaN at their ends).
namespace packtrace {

/// The largest size of a coordinate, a length or any other number. A ray that grazes a plane finds
/// it some 1e7 times as far away, and single precision holds the square of that.
inline constexpr double largest_number = 1e13;

/// The smallest size of a length.
inline constexpr double smallest_length = 1e-15;

/// Of a factor or an intensity. Products of three are far within single precision.
inline constexpr double largest_factor = 1e9;

/// Of an exponent, and of an index of refraction and its inverse. Refraction leaves the length of a
/// direction off by some roundoffs times the square of that index, and highlights are a power of
/// it.
inline constexpr double largest_exponent = 1e4;
inline constexpr double largest_ior = 10.0;

}  // namespace packtrace
