#pragma once

#include "kernels/vec3.hpp"

// Per-lane look-up of records by number. Neighbouring rays mostly ask for the same record, so
// each distinct one is loaded once and blended into its lanes: no gathers.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Calls `visit(number, lanes)` for each distinct number among the lanes of `active`.
template <class Real, class Visit>
inline void for_each_distinct(const vint<Real>& number, std::uint32_t active, const Visit& visit)
{
    alignas(64) lane_int<Real> by_lane[lanes<Real>];
    store(by_lane, number);
    while (active != 0) {
        const lane_int<Real> value = by_lane[__builtin_ctz(active)];
        const auto same = int_equal(number, vint<Real>(value));
        visit(value, same);
        active &= ~bits(same);
    }
}

template <int Fields, class Real>
struct RecordPacket {
    vreal<Real> field[static_cast<std::size_t>(Fields)];

    Vec3v<Real> vector(int first) const
    {
        return {field[first], field[first + 1], field[first + 2]};
    }
};

template <int Fields, class Real>
inline void blend_record(RecordPacket<Fields, Real>& records, vmask<Real> active,
                         const Real* record)
{
    for (int i = 0; i < Fields; ++i)
        records.field[i] = select(active, vreal<Real>(record[i]), records.field[i]);
}

/// Field `f` of lane l is table[number[l] * Fields + f]; inactive lanes hold some record.
template <int Fields, class Real>
inline RecordPacket<Fields, Real> fetch_records(const Real* table, const vint<Real>& number,
                                                std::uint32_t active)
{
    RecordPacket<Fields, Real> records;
    for (int i = 0; i < Fields; ++i)
        records.field[i] = vreal<Real>(Real(0));
    for_each_distinct<Real>(number, active, [&](lane_int<Real> value, vmask<Real> same) {
        blend_record<Fields, Real>(records, same, table + value * Fields);
    });
    return records;
}

/// The same of records that `find(number, room)` returns, structs of `Fields` reals: one of a
/// table, or one made in the room for one.
template <int Fields, class Record, class Real, class Find>
inline RecordPacket<Fields, Real> find_records(const vint<Real>& number, std::uint32_t active,
                                               const Find& find)
{
    static_assert(sizeof(Record) == Fields * sizeof(Real));
    RecordPacket<Fields, Real> records;
    for (int i = 0; i < Fields; ++i)
        records.field[i] = vreal<Real>(Real(0));
    for_each_distinct<Real>(number, active, [&](lane_int<Real> value, vmask<Real> same) {
        Record room;
        const Record& record = find(value, room);
        blend_record<Fields, Real>(records, same, &record.anchor[0]);
    });
    return records;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
