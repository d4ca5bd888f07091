#pragma once

#include <packtrace/scene.hpp>

#include "scene/block.hpp"

#include <map>
#include <string>
#include <string_view>

// The steps from a block of the syntax tree to a part of the scene. Each throws SceneError at
// the place that is wrong.
namespace packtrace::reader {

/// The whole: `tree` is the file's.
[[nodiscard]] Scene build_scene(const Source& source, const Entry& tree);

using NamedMaterials = std::map<std::string_view, Material>;

/// The keys of the scene itself: size, viewport, background, limits. `illumination` is set.
void build_settings(const Block& file, Scene& scene);

[[nodiscard]] Illumination read_illumination(const Block& file);

/// Pose and field of view.
void build_camera(const Field& field, Camera& camera);
/// The rotation that looks from `position` to `target`. Throws at `field`, the key look_at,
/// when the view direction is zero or along `up`.
[[nodiscard]] Mat3 view_rotation(const Field& field, const Vec3& position, const Vec3& target,
                                 const Vec3& up);

[[nodiscard]] Light build_light(const Field& field);

/// The keys of a material under a model, `color` too where the model knows it.
[[nodiscard]] const Keys& material_keys(Illumination illumination);
/// Throws at a key that belongs to a material, but of another model.
void refuse_foreign_keys(const Field& field, Illumination illumination);
/// From a block whose keys are checked: a material's own, or an object with its keys inline.
[[nodiscard]] Material build_material(const Block& block, Illumination illumination);
[[nodiscard]] NamedMaterials build_named_materials(const Block& file, Illumination illumination);

/// `keyword { … }` is a surface of this kind.
[[nodiscard]] bool is_surface(std::string_view keyword);
/// The keywords of all surfaces.
[[nodiscard]] const Keys& surface_keywords();
/// The keys that a kind of surface has besides those of every object.
[[nodiscard]] Keys surface_keys(std::string_view keyword);
[[nodiscard]] Surface build_surface(const Block& block, std::string_view keyword);
[[nodiscard]] Quadric build_quadric(const Block& block, std::string_view keyword);

/// scale, rotate, translate and matrix of an object, in the order written.
[[nodiscard]] const Keys& transform_keys();
[[nodiscard]] Mat4 build_transform(const Block& block);

/// Sets everything but the object's name.
[[nodiscard]] Object build_object(const Field& field, Illumination illumination,
                                  const NamedMaterials& materials);
/// Throws when there is none.
void build_objects(const Block& file, const NamedMaterials& materials, Scene& scene);

/// `camera` is the scene's: an orbit starts from its position.
[[nodiscard]] Animation build_animation(const Field& field, const Camera& camera);

}  // namespace packtrace::reader
