#include "lower/packed_shapes.hpp"

#include <algorithm>

#include "lower/in_parallel.hpp"
#include "lower/pack_record.hpp"

namespace packtrace {
namespace {

constexpr std::uint32_t largest_record = (1u << 28) - 1;

abi::SphereShape pack_shape(const LoweredSphere& sphere)
{
    abi::SphereShape shape;
    round_to(shape.center, sphere.center);
    shape.radius = sphere.radius;
    return shape;
}
abi::AnchoredSphere<double> pack_shape(const LoweredAnchoredSphere& sphere)
{
    return pack_anchored<double>(sphere);
}
abi::PlaneRecord<double> pack_shape(const LoweredPlane& plane)
{
    return pack_plane<double>(plane);
}
abi::QuadricRecord<double> pack_shape(const LoweredQuadric& quadric)
{
    return pack_quadric<double>(quadric);
}

abi::SurfaceKind kind_of(const LoweredSphere&)
{
    return abi::SurfaceKind::sphere;
}
abi::SurfaceKind kind_of(const LoweredAnchoredSphere&)
{
    return abi::SurfaceKind::anchored_sphere;
}
abi::SurfaceKind kind_of(const LoweredPlane&)
{
    return abi::SurfaceKind::plane;
}
abi::SurfaceKind kind_of(const LoweredQuadric&)
{
    return abi::SurfaceKind::quadric_side;
}

template <class Object>
int pieces_of(const Object&)
{
    return 1;
}
int pieces_of(const LoweredQuadric& quadric)
{
    return quadric.capped ? 3 : 1;
}

/// Packs the objects of one kind, and notes where they are.
template <class Object, class Shape>
AlignedArray<Shape> pack_kind(const std::vector<Object>& objects,
                              const std::vector<std::uint8_t>& faces_viewer,
                              AlignedArray<abi::SurfaceIndex>& index, const Shape*& view)
{
    auto shapes = AlignedArray<Shape>::unset(objects.size());
    for_each_in_parallel(objects, [&](const Object& object) {
        const auto number = static_cast<std::size_t>(&object - objects.data());
        shapes[number] = pack_shape(object);
        for (int piece = 0; piece < pieces_of(object); ++piece) {
            const auto surface = static_cast<std::size_t>(object.surface + piece);
            abi::SurfaceIndex& at = index[surface];
            at.record = static_cast<std::uint32_t>(number) & largest_record;
            at.kind = static_cast<abi::SurfaceKind>(static_cast<int>(kind_of(object)) + piece);
            at.faces_viewer = faces_viewer[surface] != 0;
        }
    });
    view = shapes.data();
    return shapes;
}

/// Where nothing is bent outwards, what is inside is convex.
bool convex(const LoweredQuadric& quadric)
{
    return quadric.square.x >= 0.0 && quadric.square.y >= 0.0 && quadric.square.z >= 0.0;
}

}  // namespace

PackedShapes::PackedShapes(const LoweredScene& lowered) : index_(lowered.material_index.size())
{
    const auto& faces = lowered.faces_viewer;
    spheres_ = pack_kind(lowered.spheres, faces, index_, view_.spheres);
    anchored_spheres_ = pack_kind(lowered.anchored_spheres, faces, index_, view_.anchored_spheres);
    planes_ = pack_kind(lowered.planes, faces, index_, view_.planes);
    quadrics_ = pack_kind(lowered.quadrics, faces, index_, view_.quadrics);
    view_.index = index_.data();
    view_.hit_again_outside =
        !std::all_of(lowered.quadrics.begin(), lowered.quadrics.end(), convex);
}

}  // namespace packtrace
