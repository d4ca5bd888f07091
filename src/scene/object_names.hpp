#pragma once

#include <packtrace/scene.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

// Names of objects: their own, or a default name from their kind and number.
namespace packtrace::language {

/// Finds the default names of objects. Objects must be passed in order.
class DefaultNames {
public:
    /// Whether the next object has its default name: "sphere 1" for the first such sphere, and so
    /// on. An empty name counts as the default name.
    bool takes(const Object& object);

    /// Whether an object that was passed has this default name.
    [[nodiscard]] bool contains(std::string_view name) const;

private:
    std::array<std::size_t, 16> counts_{};  ///< by kind
};

/// The name of an object in messages: `sphere 3`, or `sphere 'ball'` if it has its own name.
[[nodiscard]] std::string label_of(std::string_view kind, const std::optional<std::string>& own,
                                   std::size_t number);
[[nodiscard]] std::string label_of(const Scene& scene, std::size_t object);

/// The indices of two objects with the same name.
struct DuplicateName {
    std::size_t object;
    std::size_t earlier;
};
[[nodiscard]] std::optional<DuplicateName> find_duplicate_name(const Scene& scene);

}  // namespace packtrace::language
