#pragma once

#include <array>

#include "lower/lowered_scene.hpp"

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

}  // namespace packtrace
