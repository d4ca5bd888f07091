#pragma once

#include <packtrace/scene.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

// What objects are called: by the name they have, or by their kind and number.
namespace packtrace::language {

/// Finds the names of objects that have none of their own, one object after the other.
class DefaultNames {
public:
    /// Whether the next object's name is the one that it gets without a name of its own:
    /// "sphere 1" of the first such sphere. An empty name stands for that one.
    bool takes(const Object& object);

    /// Whether an object that has been passed has this name by default.
    [[nodiscard]] bool contains(std::string_view name) const;

private:
    std::array<std::size_t, 16> counts_{};  ///< by kind
};

/// The object as messages call it: `sphere 3`, or `sphere 'ball'` where it has its own name.
[[nodiscard]] std::string label_of(std::string_view kind, const std::optional<std::string>& own,
                                   std::size_t number);
[[nodiscard]] std::string label_of(const Scene& scene, std::size_t object);

/// Of two objects with the same name.
struct DuplicateName {
    std::size_t object;
    std::size_t earlier;
};
[[nodiscard]] std::optional<DuplicateName> find_duplicate_name(const Scene& scene);

}  // namespace packtrace::language
