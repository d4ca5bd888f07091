#pragma once

#include <packtrace/vec.hpp>

#include <array>
#include <optional>
#include <string>
#include <variant>

namespace packtrace {

/// The illumination model of a scene. Each note has its own. All of them lower to the one equation
/// of `general`.
enum class Illumination { scratch, sketch, whitted, shader, general };

/// Note 001.
struct ScratchMaterial {
    /// Exponent of the highlight, whose colour is multiplied by the material's; -1 for none.
    double specular = -1.0;
    /// Share of the mirrored light, in [0, 1].
    double reflective = 0.0;

    bool operator==(const ScratchMaterial&) const = default;
};

/// Note 000. `ambient` and `diffuse` multiply the colour; the other coefficients do not.
struct SketchMaterial {
    Rgb ambient{0.0};
    Rgb diffuse{0.0};
    Rgb specular{0.0};    ///< mirror and highlight
    Rgb refractive{0.0};  ///< transmitted share
    double shininess = 1.0;
    double ior = 1.0;

    bool operator==(const SketchMaterial&) const = default;
};

/// Note 002 (Whitted 1980). `ambient` and `diffuse` multiply the colour; the other coefficients do
/// not.
struct WhittedMaterial {
    Rgb ambient{0.0};
    Rgb diffuse{0.0};
    Rgb specular{0.0};      ///< mirror and highlight
    Rgb transmissive{0.0};  ///< transmitted share
    double shininess = 1.0;
    double ior = 1.0;

    bool operator==(const WhittedMaterial&) const = default;
};

/// Note 004: f = r0 + r1 * Id + r2 * Is^r3.
struct ShaderMaterial {
    std::array<double, 4> reflectance{0.0, 0.0, 0.0, 1.0};

    bool operator==(const ShaderMaterial&) const = default;
};

/// The engine's own equation. No coefficient multiplies the colour, which is not used.
struct GeneralMaterial {
    Rgb ambient{0.0};
    Rgb diffuse{0.0};
    Rgb highlight{0.0};
    Rgb reflect{0.0};
    Rgb transmit{0.0};
    double shininess = 1.0;
    double ior = 1.0;

    bool operator==(const GeneralMaterial&) const = default;
};

/// Squares of two colours on a plane. `Material::color` is the colour of the square at the plane's
/// point.
struct Checker {
    Rgb other{0.0};
    double size = 1.0;  ///< edge of a square, scene units, > 0

    bool operator==(const Checker&) const = default;
};

struct Material {
    std::string name;  ///< empty for a material that its object defines itself
    Rgb color{1.0};
    std::optional<Checker> checker;  ///< planes only
    /// Must hold the alternative of the scene's `Illumination`; validate() checks it.
    std::variant<ScratchMaterial, SketchMaterial, WhittedMaterial, ShaderMaterial, GeneralMaterial>
        model;

    bool operator==(const Material&) const = default;
};

}  // namespace packtrace
