#include "lower/packed_scene.hpp"

#include <algorithm>
#include <limits>

#include "lower/pack_form.hpp"
#include "lower/pack_record.hpp"
#include "lower/pack_stiff.hpp"

namespace packtrace {
namespace {

/// Below this number objects stay in a list. A round number: where the two cross is not measured.
constexpr std::size_t tree_objects = 32;

bool wants_tree(const LoweredScene& lowered, Traversal traversal)
{
    return traversal == Traversal::tree ||
           (traversal == Traversal::automatic && count_tree_objects(lowered) >= tree_objects);
}

bool any(const std::vector<bool>& marked)
{
    return std::find(marked.begin(), marked.end(), true) != marked.end();
}

/// How many roundoffs rays start off a surface by. Hits in single precision are solved again or
/// sharpened in double and rounded once; those in double are as the search found them. Measured in
/// docs/numerics.md.
template <class Real>
constexpr Real start_roundoffs = sizeof(Real) == sizeof(float) ? Real(8) : Real(32);

}  // namespace

template <class Real>
PackedScene<Real>::PackedScene(const LoweredScene& lowered, Traversal traversal)
    : surfaces_(lowered.material_index.size())
{
    if (wants_tree(lowered, traversal))
        tree_ = PackedTree<Real>(lowered);
    view_.tree = tree_.view();
    pack_spheres(lowered);
    pack_huge_spheres(lowered);
    pack_planes(lowered);
    pack_quadrics(lowered);
    pack_stiff(lowered);
    pack_finish(lowered);
    pack_forms(lowered);
    pack_normals(lowered);
    pack_materials(lowered);
    pack_lights(lowered);
    round_to(view_.background, lowered.background);
    round_to(view_.limit_color, lowered.limit_color);
    view_.max_depth = lowered.max_depth;
    view_.shadows = lowered.shadows;
    view_.transparent_shadows = lowered.transparent_shadows;
    view_.visible_lights = lowered.visible_lights;
    view_.precise_powers = sizeof(Real) == sizeof(float) && lowered.precise_powers;
    view_.units = lowered.units;
    view_.epsilon = static_cast<Real>(lowered.epsilon);
    if (lowered.self_hits == SelfHits::note)
        view_.secondary_t_min = view_.epsilon;
    else
        view_.start_error = start_roundoffs<Real> * std::numeric_limits<Real>::epsilon() / 2;
}

template <class Real>
void PackedScene<Real>::pack_spheres(const LoweredScene& lowered)
{
    const std::size_t stride = (tree_.view().empty() ? lowered.spheres.size() : 0) + abi::padding;
    sphere_reals_ = AlignedArray<Real>(5 * stride);
    sphere_surfaces_ = AlignedArray<abi::lane_int<Real>>(stride);
    Real* reals = sphere_reals_.data();
    std::size_t count = 0;
    for (const LoweredSphere& sphere : lowered.spheres) {
        if (sphere.huge)
            continue;
        auto& surface = surfaces_[static_cast<std::size_t>(sphere.surface)];
        round_to(surface.anchor, sphere.center);
        surface.curvature = static_cast<Real>(1.0 / sphere.radius);
        if (in_tree(sphere) || goes_to_stiff<Real>(sphere))
            continue;
        for (int axis = 0; axis < 3; ++axis)
            reals[static_cast<std::size_t>(axis) * stride + count] =
                static_cast<Real>(sphere.center[axis]);
        reals[3 * stride + count] = static_cast<Real>(sphere.radius);
        reals[4 * stride + count] = static_cast<Real>(sphere.radius * sphere.radius);
        sphere_surfaces_[count] = sphere.surface;
        ++count;
    }
    view_.spheres = {reals,
                     reals + stride,
                     reals + 2 * stride,
                     reals + 3 * stride,
                     reals + 4 * stride,
                     sphere_surfaces_.data(),
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
        if (!goes_to_stiff<Real>(sphere))
            huge_spheres_[static_cast<std::size_t>(count++)] = packed;
        auto& surface = surfaces_[static_cast<std::size_t>(sphere.surface)];
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
    std::size_t count = 0;
    for (const LoweredPlane& plane : lowered.planes) {
        auto& surface = surfaces_[static_cast<std::size_t>(plane.surface)];
        round_to(surface.normal, plane.normal);
        if (!goes_to_stiff<Real>(plane))
            planes_[count++] = pack_plane<Real>(plane);
    }
    view_.planes = {planes_.data(), static_cast<int>(count)};
}

template <class Real>
void PackedScene<Real>::pack_quadrics(const LoweredScene& lowered)
{
    quadrics_ = AlignedArray<abi::QuadricRecord<Real>>(lowered.quadrics.size());
    std::size_t count = 0;
    for (const LoweredQuadric& quadric : lowered.quadrics)
        if (!in_tree(quadric) && !goes_to_stiff<Real>(quadric))
            quadrics_[count++] = pack_quadric<Real>(quadric);
    view_.quadrics = {quadrics_.data(), static_cast<int>(count)};
}

/// All that is stiff, in double whatever Real is; nothing where Real is double itself.
template <class Real>
void PackedScene<Real>::pack_stiff(const LoweredScene& lowered)
{
    stiff_ = AlignedArray<abi::StiffObject>(lowered.spheres.size() + lowered.planes.size() +
                                            lowered.quadrics.size());
    std::size_t count = 0;
    const auto pack = [&](const auto& surfaces) {
        for (const auto& surface : surfaces)
            if (goes_to_stiff<Real>(surface))
                stiff_[count++] = pack_stiff_object(surface);
    };
    pack(lowered.spheres);
    pack(lowered.planes);
    pack(lowered.quadrics);
    view_.stiff = {stiff_.data(), static_cast<int>(count)};
}

template <class Real>
void PackedScene<Real>::pack_finish(const LoweredScene& lowered)
{
    const auto& wanted = lowered.finished;
    if (sizeof(Real) != sizeof(float) || !any(wanted))
        return;
    finish_ = AlignedArray<abi::StiffObject>(lowered.spheres.size() + lowered.planes.size() +
                                             lowered.quadrics.size());
    finish_index_ = AlignedArray<std::int32_t>(wanted.size());
    std::fill_n(finish_index_.data(), wanted.size(), -1);
    std::int32_t count = 0;
    const auto pack = [&](const auto& surfaces, const auto& pieces) {
        for (const auto& surface : surfaces) {
            const auto first = static_cast<std::size_t>(surface.surface);
            if (!wanted[first])
                continue;
            finish_[static_cast<std::size_t>(count)] = pack_stiff_object(surface);
            std::fill_n(finish_index_.data() + first, pieces(surface), count++);
        }
    };
    pack(lowered.spheres, [](const LoweredSphere&) { return 1; });
    pack(lowered.planes, [](const LoweredPlane&) { return 1; });
    pack(lowered.quadrics, [](const LoweredQuadric& quadric) { return quadric.capped ? 3 : 1; });
    view_.finish = finish_.data();
    view_.finish_index = finish_index_.data();
}

/// Equations of all surfaces, where hits are sharpened or rays start from the exact place.
template <class Real>
void PackedScene<Real>::pack_forms(const LoweredScene& lowered)
{
    const bool single = sizeof(Real) == sizeof(float);
    if (!(single && any(lowered.sharpened)) && lowered.self_hits == SelfHits::note)
        return;
    forms_ = AlignedArray<abi::SurfaceForm>(lowered.material_index.size());
    const auto put = [&](std::int32_t surface, const abi::SurfaceForm& form) {
        const auto at = static_cast<std::size_t>(surface);
        forms_[at] = form;
        const bool sharpened = single && lowered.sharpened[at] && !lowered.finished[at];
        forms_[at].sharpened = sharpened ? 1 : 0;
        view_.sharpened = view_.sharpened || sharpened;
    };
    for (const LoweredSphere& sphere : lowered.spheres)
        put(sphere.surface, pack_form(sphere));
    for (const LoweredPlane& plane : lowered.planes)
        put(plane.surface, pack_form(plane));
    for (const LoweredQuadric& quadric : lowered.quadrics)
        for (int piece = 0; piece < (quadric.capped ? 3 : 1); ++piece)
            put(quadric.surface + piece, pack_form(quadric, piece));
    view_.forms = forms_.data();
}

/// Round surfaces have their normals already; the kernels of every kind of surface take them in
/// the form of the curved ones.
template <class Real>
void PackedScene<Real>::pack_normals(const LoweredScene& lowered)
{
    const std::size_t count = surfaces_.size();
    for (std::size_t i = 0; i < count; ++i)
        surfaces_[i].faces_viewer = lowered.faces_viewer[i] ? Real(1) : Real(0);
    view_.surfaces = surfaces_.data();

    curved_surfaces_ = AlignedArray<abi::CurvedSurfaceRecord<Real>>(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::copy(surfaces_[i].anchor, surfaces_[i].anchor + 3, curved_surfaces_[i].anchor);
        std::copy(surfaces_[i].normal, surfaces_[i].normal + 3, curved_surfaces_[i].normal);
        std::fill_n(curved_surfaces_[i].curvature, 3, surfaces_[i].curvature);
    }
    for (const LoweredQuadric& quadric : lowered.quadrics) {
        const auto first = static_cast<std::size_t>(quadric.surface);
        curved_surfaces_[first] = side_normal<Real>(quadric);
        for (int cap = 1; quadric.capped && cap <= 2; ++cap)
            curved_surfaces_[first + static_cast<std::size_t>(cap)] =
                cap_normal<Real>(quadric, cap);
    }
    for (std::size_t i = 0; i < count; ++i)
        curved_surfaces_[i].faces_viewer = surfaces_[i].faces_viewer;
    view_.curved_surfaces = curved_surfaces_.data();
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
    ior_ = AlignedArray<Real>(lowered.ior.size() + 1);
    ior_[0] = 1;
    for (std::size_t i = 0; i < lowered.ior.size(); ++i)
        ior_[i + 1] = static_cast<Real>(lowered.ior[i]);
    view_.ior = ior_.data() + 1;
    view_.material_index = material_index_.data();
    view_.materials = materials_.data();
    view_.checkers = checkers_.data();
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
