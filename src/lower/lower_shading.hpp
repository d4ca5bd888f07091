#pragma once

#include "lower/lowered_scene.hpp"

#include <array>
#include <cstdint>
#include <vector>

// The illumination models of all notes as coefficients and rules of the common shading equation.
namespace packtrace {

/// Finds recently used materials, so that objects of one material share its record. It remembers
/// few: even in a scene where each object has a material of its own the search costs little.
class RecentMaterials {
public:
    RecentMaterials()
    {
        indices_.fill(-1);
    }

    /// The index of `material` in `materials`, to which it is appended if it is not found.
    [[nodiscard]] std::int32_t index_of(const LoweredMaterial& material,
                                        std::vector<LoweredMaterial>& materials);

private:
    static constexpr std::size_t remembered = 1024;  ///< 4 kB

    std::array<std::int32_t, remembered> indices_;  ///< by hash; -1 for none
    std::int32_t latest_ = -1;
};

/// Sums of the lights' intensities, which become part of lowered materials.
struct LightSums {
    Rgb ambient{0.0};  ///< of the ambient lights
    Rgb all{0.0};      ///< of every light
};

[[nodiscard]] LightSums sum_lights(const Scene& scene);

/// Appends the checker of `object`, and its material unless `recent` knows it; returns the indices
/// of both.
[[nodiscard]] abi::MaterialIndex lower_material(const Object& object, std::int32_t number,
                                                const LightSums& lights, RecentMaterials& recent,
                                                LoweredScene& lowered);

/// Sets what follows from the illumination model and the scene's settings, and the lights.
void lower_model_rules(const Scene& scene, LoweredScene& lowered);

/// Whether the model shades with the normal turned against the ray, rather than outwards.
[[nodiscard]] bool normal_faces_viewer(const Scene& scene, const Object& object);

}  // namespace packtrace
