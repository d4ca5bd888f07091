#include "lower/packed_shapes.hpp"

#include "core/in_parallel.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace packtrace {
namespace {

/// Leaves of a BVH have run_count_shift bits for an object's number; abi::SurfaceIndex has 28.
constexpr std::size_t most_objects = std::size_t{1} << abi::run_count_shift;
constexpr std::uint32_t largest_record = (1u << 28) - 1;
static_assert(most_objects - 1 <= largest_record);

void check_count(std::size_t objects)
{
    if (objects > most_objects)
        throw std::length_error("scene: has " + std::to_string(objects) +
                                " objects of one kind; it can have " +
                                std::to_string(most_objects) + " at most");
}

/// Packs the objects of one kind, and records their indices.
template <class Object, class Shape>
AlignedArray<Shape> pack_kind(const std::vector<Object>& objects,
                              const std::vector<std::uint8_t>& faces_viewer,
                              AlignedArray<abi::SurfaceIndex>& index, const Shape*& view)
{
    check_count(objects.size());
    auto shapes = AlignedArray<Shape>::unset(objects.size());
    for_each_in_parallel(objects, [&](const Object& object) {
        const auto number = static_cast<std::size_t>(&object - objects.data());
        shapes[number] = shape_of(object);
        for (int piece = 0; piece < pieces_of(object); ++piece) {
            const auto surface = static_cast<std::size_t>(object.surface + piece);
            abi::SurfaceIndex& at = index[surface];
            at.record = static_cast<std::uint32_t>(number) & largest_record;
            at.kind = static_cast<abi::SurfaceKind>(static_cast<int>(Object::kind) + piece);
            at.faces_viewer = faces_viewer[surface] != 0;
        }
    });
    view = shapes.data();
    return shapes;
}

bool any_hit_again_outside(const LoweredScene& lowered)
{
    return !std::all_of(lowered.quadrics.begin(), lowered.quadrics.end(), is_convex);
}

}  // namespace

PackedShapes::PackedShapes(const LoweredScene& lowered) : index_(lowered.material_index.size())
{
    for_each_kind([&](auto list) {
        using Kind = KindOf<decltype(list)>;
        auto& shapes = std::get<AlignedArray<ShapeOf<Kind>>>(shapes_);
        shapes = pack_kind(lowered.*list, lowered.faces_viewer, index_, view_.*Kind::shapes);
    });
    pack_corners(lowered);
    view_.index = index_.data();
    view_.hit_again_outside = any_hit_again_outside(lowered);
}

void PackedShapes::move(const LoweredScene& lowered)
{
    for_each_kind([&](auto list) {
        using Kind = KindOf<decltype(list)>;
        auto& shapes = std::get<AlignedArray<ShapeOf<Kind>>>(shapes_);
        const auto& objects = lowered.*list;
        for_each_in_parallel(objects, [&](const Kind& object) {
            shapes[static_cast<std::size_t>(&object - objects.data())] = shape_of(object);
        });
    });
    pack_corners(lowered);
    view_.hit_again_outside = any_hit_again_outside(lowered);
}

void PackedShapes::pack_corners(const LoweredScene& lowered)
{
    std::vector<const LoweredPolygon*> polygons;
    for (const LoweredPolygon& polygon : lowered.polygons)
        polygons.push_back(&polygon);
    auto& records = std::get<AlignedArray<abi::PolygonRecord<double>>>(shapes_);
    polygon_corners_ = PackedCorners<double>(polygons, {records.data(), records.size()});
}

}  // namespace packtrace
