#include "lower/packed_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace packtrace {
namespace {

template <class Real>
void round_to(Real (&to)[3], const Vec3& from)
{
    for (int axis = 0; axis < 3; ++axis)
        to[axis] = static_cast<Real>(from[axis]);
}

template <class Real>
Vec3 widen(const Real (&from)[3])
{
    return {from[0], from[1], from[2]};
}

/// The curvature form around the anchor as rounded: what rounding moved goes into the offset.
template <class Real>
abi::HugeSphere<Real> pack_huge(const LoweredSphere& sphere)
{
    abi::HugeSphere<Real> packed;
    round_to(packed.anchor, sphere.anchor);
    const Vec3 outwards = widen(packed.anchor) - sphere.center;
    const double distance = glm::length(outwards);
    round_to(packed.normal, outwards / sphere.radius);
    packed.curvature = static_cast<Real>(1.0 / sphere.radius);
    packed.offset =
        static_cast<Real>((distance - sphere.radius) * (distance + sphere.radius) / sphere.radius);
    packed.object = sphere.object;
    return packed;
}

/// Below this cosine the highlight is less than the smallest normal number and counts as 0; a
/// little lower, so that the kernel's own power is 0 there too.
template <class Real>
Real highlight_floor(const LoweredMaterial& material)
{
    if (material.highlight == Rgb(0.0))
        return std::numeric_limits<Real>::infinity();
    const double smallest = std::numeric_limits<Real>::min_exponent - 1;
    return static_cast<Real>(std::exp2(smallest / material.shininess) * (1.0 - 1e-6));
}

template <class Real>
abi::MaterialRecord<Real> pack_material(const LoweredMaterial& material)
{
    abi::MaterialRecord<Real> packed;
    round_to(packed.ambient, material.ambient);
    round_to(packed.diffuse, material.diffuse);
    round_to(packed.highlight, material.highlight);
    round_to(packed.reflect, material.reflect);
    round_to(packed.local, material.local);
    packed.shininess = static_cast<Real>(material.shininess);
    packed.highlight_floor = highlight_floor<Real>(material);
    return packed;
}

}  // namespace

template <class Real>
PackedScene<Real>::PackedScene(const LoweredScene& lowered)
    : surfaces_(lowered.material_index.size())
{
    pack_spheres(lowered);
    pack_huge_spheres(lowered);
    pack_planes(lowered);
    pack_materials(lowered);
    pack_lights(lowered);
    view_.surfaces = surfaces_.data();
    round_to(view_.background, lowered.background);
    view_.max_depth = lowered.max_depth;
    view_.shadows = lowered.shadows;
    view_.epsilon = static_cast<Real>(lowered.epsilon);
}

template <class Real>
void PackedScene<Real>::pack_spheres(const LoweredScene& lowered)
{
    const std::size_t stride = lowered.spheres.size() + abi::padding;
    sphere_reals_ = AlignedArray<Real>(5 * stride);
    sphere_objects_ = AlignedArray<abi::lane_int<Real>>(stride);
    Real* reals = sphere_reals_.data();
    std::size_t count = 0;
    for (const LoweredSphere& sphere : lowered.spheres) {
        if (sphere.huge)
            continue;
        for (int axis = 0; axis < 3; ++axis)
            reals[static_cast<std::size_t>(axis) * stride + count] =
                static_cast<Real>(sphere.center[axis]);
        reals[3 * stride + count] = static_cast<Real>(sphere.radius);
        reals[4 * stride + count] = static_cast<Real>(sphere.radius * sphere.radius);
        sphere_objects_[count] = sphere.object;
        auto& surface = surfaces_[static_cast<std::size_t>(sphere.object)];
        round_to(surface.anchor, sphere.center);
        surface.curvature = static_cast<Real>(1.0 / sphere.radius);
        ++count;
    }
    view_.spheres = {reals,
                     reals + stride,
                     reals + 2 * stride,
                     reals + 3 * stride,
                     reals + 4 * stride,
                     sphere_objects_.data(),
                     static_cast<int>(count)};
}

template <class Real>
void PackedScene<Real>::pack_huge_spheres(const LoweredScene& lowered)
{
    huge_spheres_ = AlignedArray<abi::HugeSphere<Real>>(lowered.spheres.size());
    int count = 0;
    for (const LoweredSphere& sphere : lowered.spheres) {
        if (!sphere.huge)
            continue;
        const auto packed = pack_huge<Real>(sphere);
        huge_spheres_[static_cast<std::size_t>(count++)] = packed;
        auto& surface = surfaces_[static_cast<std::size_t>(sphere.object)];
        std::copy(packed.anchor, packed.anchor + 3, surface.anchor);
        std::copy(packed.normal, packed.normal + 3, surface.normal);
        surface.curvature = packed.curvature;
    }
    view_.huge_spheres = {huge_spheres_.data(), count};
}

template <class Real>
void PackedScene<Real>::pack_planes(const LoweredScene& lowered)
{
    planes_ = AlignedArray<abi::PlaneRecord<Real>>(lowered.planes.size());
    for (std::size_t i = 0; i < lowered.planes.size(); ++i) {
        const LoweredPlane& plane = lowered.planes[i];
        round_to(planes_[i].point, plane.point);
        round_to(planes_[i].normal, plane.normal);
        planes_[i].object = plane.object;
        auto& surface = surfaces_[static_cast<std::size_t>(plane.object)];
        round_to(surface.normal, plane.normal);
        surface.faces_viewer = 1;
    }
    view_.planes = {planes_.data(), static_cast<int>(lowered.planes.size())};
}

template <class Real>
void PackedScene<Real>::pack_materials(const LoweredScene& lowered)
{
    material_index_ = AlignedArray<abi::MaterialIndex>(lowered.material_index.size());
    std::copy(lowered.material_index.begin(), lowered.material_index.end(), material_index_.data());
    materials_ = AlignedArray<abi::MaterialRecord<Real>>(lowered.materials.size());
    for (std::size_t i = 0; i < lowered.materials.size(); ++i)
        materials_[i] = pack_material<Real>(lowered.materials[i]);
    checkers_ = AlignedArray<abi::CheckerRecord<Real>>(lowered.checkers.size());
    for (std::size_t i = 0; i < lowered.checkers.size(); ++i) {
        round_to(checkers_[i].point, lowered.checkers[i].point);
        round_to(checkers_[i].u, lowered.checkers[i].u);
        round_to(checkers_[i].v, lowered.checkers[i].v);
    }
    view_.material_index = material_index_.data();
    view_.materials = materials_.data();
    view_.checkers = checkers_.data();
    view_.checker_count = static_cast<int>(lowered.checkers.size());
}

template <class Real>
void PackedScene<Real>::pack_lights(const LoweredScene& lowered)
{
    lights_ = AlignedArray<abi::LightRecord<Real>>(lowered.lights.size());
    for (std::size_t i = 0; i < lowered.lights.size(); ++i) {
        const Light& light = lowered.lights[i];
        round_to(lights_[i].intensity, light.intensity);
        round_to(lights_[i].vector, light.vector);
        lights_[i].kind =
            light.type == LightType::point ? abi::LightKind::point : abi::LightKind::directional;
    }
    view_.lights = {lights_.data(), static_cast<int>(lowered.lights.size())};
}

template class PackedScene<float>;
template class PackedScene<double>;

}  // namespace packtrace
