#pragma once

#include <packtrace/scene.hpp>

#include <stdexcept>

namespace packtrace::reference {

/// The shading keys of an object in the model that the scene is lit by.
template <class Model>
[[nodiscard]] const Model& model_of(const Object& object)
{
    if (const auto* model = std::get_if<Model>(&object.material.model))
        return *model;
    throw std::invalid_argument("object '" + object.name +
                                "' has a material of another illumination model");
}

}  // namespace packtrace::reference
