#include "lower/packed_lists.hpp"

#include "lower/tree_objects.hpp"

namespace packtrace {
namespace {

/// The objects that no hierarchy holds.
template <class Object>
std::vector<const Object*> listed(const LoweredScene& lowered, const std::vector<Object>& objects,
                                  bool is_tree)
{
    std::vector<const Object*> list;
    for (const Object& object : objects)
        if (!is_tree || !is_in_tree(lowered, object))
            list.push_back(&object);
    return list;
}

template <class Object, class Record>
void pack_all(const std::vector<const Object*>& objects, AlignedArray<Record>& records,
              Record (*pack)(const Object&))
{
    records = AlignedArray<Record>(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i)
        records[i] = pack(*objects[i]);
}

template <class Record>
abi::RecordList<Record> list_of(const AlignedArray<Record>& records)
{
    return {records.data(), static_cast<int>(records.size())};
}

}  // namespace

template <class Real>
PackedLists<Real>::PackedLists(const LoweredScene& lowered, bool is_tree)
{
    const auto unheld = [&](const auto& objects) { return listed(lowered, objects, is_tree); };
    pack_spheres(unheld(lowered.spheres));
    pack_all(unheld(lowered.anchored_spheres), anchored_spheres_, pack<Real>);
    pack_all(unheld(lowered.planes), planes_, pack<Real>);
    pack_all(unheld(lowered.quadrics), quadrics_, pack<Real>);
    const auto polygons = unheld(lowered.polygons);
    pack_all(polygons, polygons_, pack<Real>);
    polygon_corners_ = PackedCorners<Real>(polygons, {polygons_.data(), polygons_.size()});
}

template <class Real>
void PackedLists<Real>::pack_spheres(const std::vector<const LoweredSphere*>& spheres)
{
    sphere_count_ = static_cast<int>(spheres.size());
    sphere_stride_ = spheres.size() + abi::padding;
    sphere_reals_ = AlignedArray<Real>(6 * sphere_stride_);
    sphere_surfaces_ = AlignedArray<abi::lane_int<Real>>(sphere_stride_);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const LoweredSphere& sphere = *spheres[i];
        Real* const place = sphere_reals_.data() + i;
        for (int axis = 0; axis < 3; ++axis)
            place[static_cast<std::size_t>(axis) * sphere_stride_] =
                static_cast<Real>(sphere.center[axis]);
        place[3 * sphere_stride_] = static_cast<Real>(sphere.radius);
        // Of the rounded radius, as a hierarchy has it.
        place[4 * sphere_stride_] = place[3 * sphere_stride_] * place[3 * sphere_stride_];
        place[5 * sphere_stride_] = static_cast<Real>(center_error<Real>(sphere));
        sphere_surfaces_[i] = sphere.surface;
    }
}

template <class Real>
void PackedLists<Real>::show(abi::GeometryView<Real>& view) const
{
    const Real* const reals = sphere_reals_.data();
    const std::size_t stride = sphere_stride_;
    view.spheres = {reals,
                    reals + stride,
                    reals + 2 * stride,
                    reals + 3 * stride,
                    reals + 4 * stride,
                    reals + 5 * stride,
                    sphere_surfaces_.data(),
                    sphere_count_};
    view.anchored_spheres = list_of(anchored_spheres_);
    view.planes = list_of(planes_);
    view.quadrics = list_of(quadrics_);
    view.polygons = list_of(polygons_);
}

template class PackedLists<float>;
template class PackedLists<double>;

}  // namespace packtrace
