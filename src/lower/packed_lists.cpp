#include "lower/packed_lists.hpp"

namespace packtrace {
namespace {

/// The objects that no hierarchy holds.
template <class Object>
std::vector<const Object*> listed(const std::vector<Object>& objects, bool is_tree)
{
    std::vector<const Object*> list;
    for (const Object& object : objects)
        if (!is_tree || !fits_tree(object))
            list.push_back(&object);
    return list;
}

template <class Object, class Record>
void pack_all(const std::vector<Object>& objects, bool is_tree, AlignedArray<Record>& records,
              Record (*pack)(const Object&))
{
    const auto chosen = listed(objects, is_tree);
    records = AlignedArray<Record>(chosen.size());
    for (std::size_t i = 0; i < chosen.size(); ++i)
        records[i] = pack(*chosen[i]);
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
    pack_spheres(listed(lowered.spheres, is_tree));
    pack_all(lowered.anchored_spheres, is_tree, anchored_spheres_, pack<Real>);
    pack_all(lowered.planes, is_tree, planes_, pack<Real>);
    pack_all(lowered.quadrics, is_tree, quadrics_, pack<Real>);
    pack_all(lowered.polygons, is_tree, polygons_, pack<Real>);
    polygon_corners_ = PackedCorners<Real>(listed(lowered.polygons, is_tree),
                                           {polygons_.data(), polygons_.size()});
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
