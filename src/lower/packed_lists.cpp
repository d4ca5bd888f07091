#include "lower/packed_lists.hpp"

#include <algorithm>

#include "lower/pack_record.hpp"
#include "lower/packed_tree.hpp"

namespace packtrace {
namespace {

template <class Object, class Want>
std::vector<const Object*> chosen(const std::vector<Object>& objects, const Want& want)
{
    std::vector<const Object*> list;
    for (const Object& object : objects)
        if (want(object))
            list.push_back(&object);
    return list;
}

template <class Object, class Record>
AlignedArray<Record> pack_all(const std::vector<const Object*>& objects,
                              Record (*pack)(const Object&))
{
    AlignedArray<Record> records(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i)
        records[i] = pack(*objects[i]);
    return records;
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
    const auto listed = [&](const auto& object) { return !is_tree || !fits_tree(object); };
    const auto every = [](const auto&) { return true; };
    const auto spheres = chosen(lowered.spheres, listed);
    const auto anchored_spheres = chosen(lowered.anchored_spheres, every);
    const auto planes = chosen(lowered.planes, every);
    const auto quadrics = chosen(lowered.quadrics, listed);
    pack_spheres(spheres);
    anchored_spheres_ = pack_all(anchored_spheres, pack_anchored<Real>);
    planes_ = pack_all(planes, pack_plane<Real>);
    quadrics_ = pack_all(quadrics, pack_quadric<Real>);
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
}

template class PackedLists<float>;
template class PackedLists<double>;

}  // namespace packtrace
