#pragma once

#include "kernel_abi/lists.hpp"
#include "kernels/geometry/cone.hpp"
#include "kernels/geometry/error_bounds.hpp"

// Lists of objects of one kind, and the defaults for what a kind does not define.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The surfaces of one object, numbered from `first` on.
struct Body {
    std::int32_t first;
    int pieces = 1;
};

inline bool is_on(const Body& body, std::int32_t surface)
{
    return surface >= body.first && surface < body.first + body.pieces;
}

/// Default: the object has one surface.
template <class Object>
inline Body body_of(const Object& object)
{
    return {object.surface};
}

/// The lanes of `own` that are one of `pieces` surfaces numbered from `first` on.
template <class Real>
inline std::uint32_t lanes_on_body(const vint<Real>& own, std::int32_t first, int pieces = 1)
{
    std::uint32_t on_body = 0;
    for (int piece = 0; piece < pieces; ++piece)
        on_body |= bits(int_equal(own, vint<Real>(static_cast<lane_int<Real>>(first + piece))));
    return on_body;
}

/// The features for which a kind is compiled: all, or those with Features::quadrics.
enum class CompiledFor { all_features, quadrics };

/// Base of the structs of kinds (kinds.hpp). The surfaces of an object have consecutive numbers.
/// Kernels without Features::quadrics have no kind that is compiled for `quadrics`.
template <abi::Primitive P, abi::SurfaceKind First, unsigned Surfaces = 1,
          CompiledFor C = CompiledFor::all_features>
struct KindOf {
    static constexpr abi::Primitive primitive = P;
    static constexpr abi::SurfaceKind first_surface = First;
    static constexpr unsigned surfaces = Surfaces;

    static constexpr bool in(abi::Features features)
    {
        return C == CompiledFor::all_features || features.quadrics;
    }
};

template <class Object>
struct ObjectArray {
    Object* data = nullptr;
    int count = 0;
};

/// Pointers to some of a scene's records.
template <class Record>
struct SelectedRecords {
    const Record** data = nullptr;
    int count = 0;
};

template <class Object>
inline const Object& object_at(const ObjectArray<Object>& list, int index)
{
    return list.data[index];
}
template <class Record>
inline const Record& object_at(const SelectedRecords<Record>& list, int index)
{
    return *list.data[index];
}
template <class Record>
inline const Record& object_at(const abi::RecordList<Record>& list, int index)
{
    return list.data[index];
}

template <class Arena, class Object>
inline void take_memory(Arena& arena, ObjectArray<Object>& list, int count)
{
    list.data = arena.template take<Object>(static_cast<std::size_t>(count));
}
template <class Arena, class Record>
inline void take_memory(Arena& arena, SelectedRecords<Record>& list, int count)
{
    list.data = arena.template take<const Record*>(static_cast<std::size_t>(count));
}

/// Whether no ray of a cone can hit an object, judged by its bounding ball. False if the record has
/// none.
template <class Real, class Record>
inline bool out_of_reach(const Cone<Real>& cone, const Record& record)
{
    if constexpr (requires { record.bound_radius; }) {
        const Vec3v<Real> to_bound = broadcast(record.bound) - broadcast(cone.base);
        return cone.bounded &&
               none(may_meet<Real>(cone, to_bound, vreal<Real>(record.bound_radius)));
    } else {
        return false;
    }
}
/// Whether all rays of a cone leave an object behind, judged by its form for the rays' origins.
/// Default: false.
template <class Real, class Form>
inline bool leaves_behind(const Cone<Real>&, const Form&)
{
    return false;
}

/// Fills `list` with the objects that rays of `cone` may hit; all rays start at its base.
template <class Form, class Real, class Record>
inline void find_from_point(ObjectArray<Form>& list, const Cone<Real>& cone,
                            const abi::RecordList<Record>& records)
{
    const Vec3v<Real> origin = broadcast(cone.base);
    list.count = 0;
    for (int i = 0; i < records.count; ++i) {
        if (out_of_reach(cone, records.data[i]))
            continue;
        const Form form = share_origin(records.data[i], origin);
        if (!leaves_behind(cone, form))
            list.data[list.count++] = form;
    }
}

/// Fills `list` with the objects that rays of `cone` may hit.
template <class Real, class Record>
inline void find_met(SelectedRecords<Record>& list, const Cone<Real>& cone,
                     const abi::RecordList<Record>& records)
{
    list.count = 0;
    for (int i = 0; i < records.count; ++i)
        if (!out_of_reach(cone, records.data[i]))
            list.data[list.count++] = &records.data[i];
}

/// Fills `list` with the objects, and their error bounds, that rays from `origins` may hit; `cone`
/// bounds the rays.
template <Origin O, class Form, class Record, class WideRecord>
inline void find_certain(ObjectArray<Form>& list, const Origins& origins, const Cone<float>& cone,
                         const abi::RecordList<Record>& records,
                         const abi::RecordList<WideRecord>& wide)
{
    list.count = 0;
    for (int i = 0; i < wide.count; ++i) {
        if (out_of_reach(cone, records.data[i]))
            continue;
        Form& form = list.data[list.count];
        form = certain_form<O>(records.data[i], wide.data[i], origins);
        list.count += !leaves_behind(cone, form);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
