#include "lower/packed_shapes.hpp"

#include <algorithm>

#include "lower/in_parallel.hpp"
#include "lower/pack_form.hpp"
#include "lower/pack_record.hpp"
#include "lower/pack_stiff.hpp"

namespace packtrace {
namespace {

/// Marks a surface that no object here has, as where those that cast no shadow are left out.
constexpr abi::SurfacePlace no_place = ~abi::SurfacePlace{0};

template <class Object>
int pieces_of(const Object&)
{
    return 1;
}
int pieces_of(const LoweredQuadric& quadric)
{
    return quadric.capped ? 3 : 1;
}

template <class Real>
void pack_normal(const LoweredSphere& sphere, abi::SurfaceRecord<Real>& surface)
{
    round_to(surface.anchor, sphere.center);
    surface.curvature = static_cast<Real>(1.0 / sphere.radius);
}

template <class Real>
void pack_normal(const LoweredHugeSphere& sphere, abi::SurfaceRecord<Real>& surface)
{
    const auto packed = pack_huge<Real>(sphere);
    std::copy(packed.anchor, packed.anchor + 3, surface.anchor);
    std::copy(packed.normal, packed.normal + 3, surface.normal);
    surface.curvature = packed.curvature;
}

template <class Real>
void pack_normal(const LoweredPlane& plane, abi::SurfaceRecord<Real>& surface)
{
    round_to(surface.normal, plane.normal);
}

/// Quadrics have curved records only.
template <class Real>
void pack_normal(const LoweredQuadric&, abi::SurfaceRecord<Real>&)
{
}

template <class Object>
abi::SurfaceForm form_of(const Object& object, int)
{
    return pack_form(object);
}
abi::SurfaceForm form_of(const LoweredQuadric& quadric, int piece)
{
    return pack_form(quadric, piece);
}

/// Planes and spheres in the form of the curved ones, for the kernels of every kind.
template <class Real>
abi::CurvedSurfaceRecord<Real> curved(const abi::SurfaceRecord<Real>& surface)
{
    abi::CurvedSurfaceRecord<Real> record{};
    std::copy(surface.anchor, surface.anchor + 3, record.anchor);
    std::copy(surface.normal, surface.normal + 3, record.normal);
    std::fill_n(record.curvature, 3, surface.curvature);
    return record;
}

}  // namespace

template <class Real>
PackedShapes<Real>::PackedShapes(const LoweredScene& lowered, bool many_spheres)
    : many_spheres_(many_spheres),
      finishes_(sizeof(Real) == sizeof(float) &&
                std::find(lowered.finished.begin(), lowered.finished.end(), 1) !=
                    lowered.finished.end()),
      places_(AlignedArray<abi::SurfacePlace>::unset(lowered.material_index.size()))
{
    std::fill_n(places_.data(), places_.size(), no_place);
    if (many_spheres_)
        pack_sphere_shapes(lowered);
    place_others(lowered);
    std::replace(places_.data(), places_.data() + places_.size(), no_place,
                 static_cast<abi::SurfacePlace>(others_) | abi::other_shape_bit);
    pack_others(lowered);
    pack_curved(lowered);
    if (finishes_)
        pack_finish(lowered);
    pack_forms(lowered);
}

/// Calls `visit` with every object that is not among the spheres, kind by kind.
template <class Real>
template <class Visit>
void PackedShapes<Real>::for_each_other(const LoweredScene& lowered, const Visit& visit) const
{
    if (!many_spheres_)
        std::for_each(lowered.spheres.begin(), lowered.spheres.end(), visit);
    std::for_each(lowered.huge_spheres.begin(), lowered.huge_spheres.end(), visit);
    std::for_each(lowered.planes.begin(), lowered.planes.end(), visit);
    std::for_each(lowered.quadrics.begin(), lowered.quadrics.end(), visit);
}

template <class Real>
void PackedShapes<Real>::pack_sphere_shapes(const LoweredScene& lowered)
{
    spheres_ = AlignedArray<abi::SphereShape>::unset(lowered.spheres.size());
    for_each_in_parallel(lowered.spheres, [&](const LoweredSphere& sphere) {
        const auto at = static_cast<std::size_t>(&sphere - lowered.spheres.data());
        const auto surface = static_cast<std::size_t>(sphere.surface);
        round_to(spheres_[at].center, sphere.center);
        spheres_[at].radius = sphere.radius;
        places_[surface] = static_cast<abi::SurfacePlace>(at) |
                           (finishes_ && lowered.finished[surface] ? abi::finished_bit : 0) |
                           (lowered.faces_viewer[surface] ? abi::faces_viewer_bit : 0);
    });
}

template <class Real>
void PackedShapes<Real>::place_others(const LoweredScene& lowered)
{
    for_each_other(lowered, [&](const auto& object) {
        for (int piece = 0; piece < pieces_of(object); ++piece) {
            const auto surface = static_cast<std::size_t>(object.surface + piece);
            places_[surface] = static_cast<abi::SurfacePlace>(others_++) | abi::other_shape_bit;
        }
    });
}

template <class Real>
void PackedShapes<Real>::pack_others(const LoweredScene& lowered)
{
    surfaces_ = AlignedArray<abi::SurfaceRecord<Real>>(others_);
    for_each_other(lowered, [&](const auto& object) {
        pack_normal(object, surfaces_[other(object.surface)]);
        const auto surface = static_cast<std::size_t>(object.surface);
        const Real faces_viewer = lowered.faces_viewer[surface] ? Real(1) : Real(0);
        for (int piece = 0; piece < pieces_of(object); ++piece)
            surfaces_[other(object.surface + piece)].faces_viewer = faces_viewer;
    });
}

template <class Real>
void PackedShapes<Real>::pack_curved(const LoweredScene& lowered)
{
    curved_ = AlignedArray<abi::CurvedSurfaceRecord<Real>>(others_);
    for (std::size_t i = 0; i < others_; ++i)
        curved_[i] = curved(surfaces_[i]);
    for_each_in_parallel(lowered.quadrics, [&](const LoweredQuadric& quadric) {
        const std::size_t side = other(quadric.surface);
        curved_[side] = side_normal<Real>(quadric);
        for (int cap = 1; quadric.capped && cap <= 2; ++cap)
            curved_[side + static_cast<std::size_t>(cap)] = cap_normal<Real>(quadric, cap);
    });
    for (std::size_t i = 0; i < others_; ++i)
        curved_[i].faces_viewer = surfaces_[i].faces_viewer;
}

template <class Real>
void PackedShapes<Real>::pack_finish(const LoweredScene& lowered)
{
    finish_index_ = AlignedArray<std::int32_t>(others_);
    std::fill_n(finish_index_.data(), others_, -1);
    std::vector<abi::StiffObject> finish;
    for_each_other(lowered, [&](const auto& object) {
        if (!lowered.finished[static_cast<std::size_t>(object.surface)])
            return;
        std::fill_n(finish_index_.data() + other(object.surface), pieces_of(object),
                    static_cast<std::int32_t>(finish.size()));
        finish.push_back(pack_stiff_object(object));
    });
    finish_ = AlignedArray<abi::StiffObject>(finish.size());
    std::copy(finish.begin(), finish.end(), finish_.data());
}

/// What of hits gets one more step in double: nothing of rays in double, nor where they are solved
/// again.
template <class Real>
abi::Sharpened PackedShapes<Real>::sharpened(const LoweredScene& lowered,
                                             std::int32_t surface) const
{
    const auto at = static_cast<std::size_t>(surface);
    if (sizeof(Real) != sizeof(float) || lowered.sharpened.empty() || lowered.finished[at] != 0)
        return abi::Sharpened::nothing;
    return lowered.sharpened[at];
}

/// Equations of all other surfaces, where hits are sharpened or rays start from the exact place.
/// One more, for surfaces of no object here, is met by nothing.
template <class Real>
void PackedShapes<Real>::pack_forms(const LoweredScene& lowered)
{
    const bool sharpens = sizeof(Real) == sizeof(float) && !lowered.sharpened.empty();
    if (!sharpens && lowered.self_hits == SelfHits::note)
        return;
    forms_ = AlignedArray<abi::SurfaceForm>(others_ + 1);
    for_each_other(lowered, [&](const auto& object) {
        for (int piece = 0; piece < pieces_of(object); ++piece) {
            const std::int32_t surface = object.surface + piece;
            abi::SurfaceForm& form = forms_[other(surface)];
            form = form_of(object, piece);
            form.sharpened = sharpened(lowered, surface);
            most_sharpened_ = std::max(most_sharpened_, form.sharpened);
            met_again_outside_ =
                met_again_outside_ || form.met_again == abi::MetAgain::from_anywhere;
        }
    });
    if (!many_spheres_)
        return;
    // All that are sharpened are so alike: the first says it.
    const auto first = std::find_if(
        lowered.spheres.begin(), lowered.spheres.end(), [&](const LoweredSphere& sphere) {
            return sharpened(lowered, sphere.surface) != abi::Sharpened::nothing;
        });
    if (first != lowered.spheres.end())
        sharpened_spheres_ = sharpened(lowered, first->surface);
    most_sharpened_ = std::max(most_sharpened_, sharpened_spheres_);
}

template <class Real>
void PackedShapes<Real>::show(abi::SceneView<Real>& view) const
{
    view.places = places_.data();
    view.sphere_shapes = spheres_.data();
    view.surfaces = surfaces_.data();
    view.curved_surfaces = curved_.data();
    view.finish_index = finish_index_.data();
    view.finish = finish_.data();
    view.forms = forms_.data();
    view.sharpened = most_sharpened_ != abi::Sharpened::nothing;
    view.sharpened_t = most_sharpened_ == abi::Sharpened::all;
    view.sharpened_spheres = sharpened_spheres_;
    view.met_again_outside = met_again_outside_;
}

template class PackedShapes<float>;
template class PackedShapes<double>;

}  // namespace packtrace
