#pragma once

#include "lower/lowered_scene.hpp"
#include "lower/recent_materials.hpp"

namespace packtrace {

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

}  // namespace packtrace
