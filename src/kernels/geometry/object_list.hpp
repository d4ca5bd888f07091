#pragma once

#include "kernel_abi/lists.hpp"
#include "kernels/geometry/cone.hpp"
#include "kernels/geometry/error_bounds.hpp"

// Lists of objects of one kind, and what holds of an object unless its kind says otherwise.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The surfaces of one object, which are numbered from `first` on.
struct Body {
    std::int32_t first;
    int pieces = 1;
};

inline bool is_on(const Body& body, std::int32_t surface)
{
    return surface >= body.first && surface < body.first + body.pieces;
}

/// Of objects that have one surface.
template <class Object>
inline Body body_of(const Object& object)
{
    return {object.surface};
}

/// The lanes of `own` that are one of a body's `pieces`, which are numbered from `first` on.
template <class Real>
inline std::uint32_t lanes_on_body(const vint<Real>& own, std::int32_t first, int pieces = 1)
{
    std::uint32_t on_body = 0;
    for (int piece = 0; piece < pieces; ++piece)
        on_body |= bits(int_equal(own, vint<Real>(static_cast<lane_int<Real>>(first + piece))));
    return on_body;
}

/// What the loops over kinds (kinds.hpp) ask of each. Surfaces of an object are numbered in a row;
/// kernels without quadrics have none of a kind that is `WithQuadrics`.
template <abi::Primitive P, abi::SurfaceKind First, unsigned Surfaces = 1,
          bool WithQuadrics = false>
struct KindOf {
    static constexpr abi::Primitive primitive = P;
    static constexpr abi::SurfaceKind first_surface = First;
    static constexpr unsigned surfaces = Surfaces;

    static constexpr bool in(abi::Features features)
    {
        return !WithQuadrics || features.quadrics;
    }
};

template <class Object>
struct ObjectArray {
    Object* data = nullptr;
    int count = 0;
};

/// Some of a scene's records.
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
inline void take_room(Arena& arena, ObjectArray<Object>& list, int count)
{
    list.data = arena.template take<Object>(static_cast<std::size_t>(count));
}
template <class Arena, class Record>
inline void take_room(Arena& arena, SelectedRecords<Record>& list, int count)
{
    list.data = arena.template take<const Record*>(static_cast<std::size_t>(count));
}

/// Whether no ray of a cone reaches an object, by its record alone: by its bound, if it has one.
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
/// Whether all rays of a cone leave an object behind, by its form for their origin.
template <class Real, class Form>
inline bool leaves_behind(const Cone<Real>&, const Form&)
{
    return false;
}

/// Fills `list` with what rays of `cone`, all from its base, may meet.
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

/// Fills `list` with what rays of `cone` may meet.
template <class Real, class Record>
inline void find_met(SelectedRecords<Record>& list, const Cone<Real>& cone,
                     const abi::RecordList<Record>& records)
{
    list.count = 0;
    for (int i = 0; i < records.count; ++i)
        if (!out_of_reach(cone, records.data[i]))
            list.data[list.count++] = &records.data[i];
}

/// Fills `list` with the error bounds of what rays from `origins` may meet; `cone` bounds them.
template <bool Shared, class Form, class Record, class WideRecord>
inline void find_certain(ObjectArray<Form>& list, const Origins& origins, const Cone<float>& cone,
                         const abi::RecordList<Record>& records,
                         const abi::RecordList<WideRecord>& wide)
{
    list.count = 0;
    for (int i = 0; i < wide.count; ++i) {
        if (out_of_reach(cone, records.data[i]))
            continue;
        Form& form = list.data[list.count];
        form = certain_form<Shared>(records.data[i], wide.data[i], origins);
        list.count += !leaves_behind(cone, form);
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
