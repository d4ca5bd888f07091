#pragma once

#include "lower/lowered_scene.hpp"

#include <array>
#include <cstdint>
#include <vector>

// The illumination models of all notes as coefficients and rules of one equation.
namespace packtrace {

/// Finds materials again, so that objects of one material share its record. It looks among the
/// latest few hundred only: a scene of as many materials as objects costs little more for it.
class RecentMaterials {
public:
    RecentMaterials()
    {
        places_.fill(-1);
    }

    /// The place of `material` in `materials`, to which it is appended when it is not found.
    [[nodiscard]] std::int32_t place_of(const LoweredMaterial& material,
                                        std::vector<LoweredMaterial>& materials);

private:
    std::array<std::int32_t, 1024> places_;  ///< by hash; -1 for none
    std::int32_t latest_ = -1;
};

/// Sums over all lights that materials take up at lowering.
struct LightSums {
    Rgb ambient{0.0};  ///< of the ambient lights
    Rgb all{0.0};      ///< of every light
};

[[nodiscard]] LightSums sum_lights(const Scene& scene);

/// Appends the material of `object`, unless `recent` knows it, and its checker; returns where its
/// surfaces find them.
[[nodiscard]] abi::MaterialIndex lower_material(const Object& object, std::int32_t number,
                                                const LightSums& lights, RecentMaterials& recent,
                                                LoweredScene& lowered);

/// What an illumination model asks of the one equation beyond its materials.
void lower_model_rules(const Scene& scene, LoweredScene& lowered);

/// Whether the model shades a surface's normal turned against the ray, or as it points outwards.
[[nodiscard]] bool normal_faces_viewer(const Scene& scene, const Object& object);

}  // namespace packtrace
