#pragma once

#include <string>

#include <packtrace/scene.hpp>

namespace packtrace::generators {

/// What all generated pictures share: 1024 x 1024 pixels through their middles, an angle of
/// view of 45 degrees.
[[nodiscard]] Scene empty_scene(const Vec3& eye, const Vec3& target, const Vec3& up);

/// A point light and a little ambient one, which add up to 1.
[[nodiscard]] std::vector<Light> lamp_at(const Vec3& position);

/// Throws std::invalid_argument `name: …` unless low <= value <= high.
void check_option(const std::string& name, double value, double low, double high);
/// Throws unless it is finite and above 0.
void check_radius(double radius);

/// A named scratch material with a highlight.
[[nodiscard]] Material shiny(const std::string& name, const Rgb& color, double reflective);

/// The next sphere, named as the reader names those without a name.
void add_sphere(Scene& scene, const Vec3& center, double radius, const Material& material);

}  // namespace packtrace::generators
