#include "lower/packed_lists.hpp"

#include "lower/tree_objects.hpp"

namespace packtrace {
namespace {

template <class Object>
std::vector<const Object*> listed(const LoweredScene& lowered, const std::vector<Object>& objects,
                                  Listed which)
{
    std::vector<const Object*> list;
    for (const Object& object : objects)
        if (which == Listed::all || !is_in_bvh(lowered, object))
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
PackedLists<Real>::PackedLists(const LoweredScene& lowered, Listed which)
{
    const auto list = [&](const auto& objects) { return listed(lowered, objects, which); };
    pack_spheres(list(lowered.spheres));
    pack_all(list(lowered.anchored_spheres), anchored_spheres_, pack<Real>);
    pack_all(list(lowered.planes), planes_, pack<Real>);
    pack_all(list(lowered.quadrics), quadrics_, pack<Real>);
    const auto polygons = list(lowered.polygons);
    pack_all(polygons, polygons_, pack<Real>);
    polygon_corners_ = PackedCorners<Real>(polygons, {polygons_.data(), polygons_.size()});
}

/// Six arrays one after the other: x, y and z of the centre, radius, its square, error of the
/// centre.
template <class Real>
void PackedLists<Real>::pack_spheres(const std::vector<const LoweredSphere*>& spheres)
{
    sphere_count_ = static_cast<int>(spheres.size());
    sphere_stride_ = spheres.size() + abi::padding;
    sphere_reals_ = AlignedArray<Real>(6 * sphere_stride_);
    sphere_surfaces_ = AlignedArray<abi::lane_int<Real>>(sphere_stride_);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const LoweredSphere& sphere = *spheres[i];
        Real* const reals = sphere_reals_.data() + i;
        for (int axis = 0; axis < 3; ++axis)
            reals[static_cast<std::size_t>(axis) * sphere_stride_] =
                static_cast<Real>(sphere.center[axis]);
        reals[3 * sphere_stride_] = static_cast<Real>(sphere.radius);
        // The square of the rounded radius, as for spheres of a BVH.
        reals[4 * sphere_stride_] = reals[3 * sphere_stride_] * reals[3 * sphere_stride_];
        reals[5 * sphere_stride_] = static_cast<Real>(center_error<Real>(sphere));
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
