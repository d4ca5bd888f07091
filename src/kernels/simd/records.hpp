#pragma once

#include "kernels/simd/vec3.hpp"

#include <utility>

// Looks up a record per lane, by number. Neighbouring rays mostly need the same record, so each
// distinct record is loaded once and blended into its lanes. No gather instructions are used.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// A cursor over the distinct numbers in the active lanes, of which there is at least one.
template <class Real>
class DistinctNumbers {
public:
    DistinctNumbers(const vint<Real>& number, std::uint32_t active)
        : number_(number), left_(active), value_(first_of(number, active))
    {
    }

    [[nodiscard]] lane_int<Real> value() const
    {
        return value_;
    }
    /// The lanes that hold value(), inactive lanes included.
    [[nodiscard]] vmask<Real> lanes_of() const
    {
        return int_equal(number_, vint<Real>(value_));
    }
    /// Whether only one number is left.
    [[nodiscard]] bool is_only() const
    {
        return (left_ & ~bits(lanes_of())) == 0;
    }
    /// Advances to the next number; false if there is none.
    bool next()
    {
        left_ &= ~bits(lanes_of());
        if (left_ == 0)
            return false;
        value_ = first_of(number_, left_);
        return true;
    }

private:
    static lane_int<Real> lane_of(const vint<Real>& number, int lane)
    {
        alignas(64) lane_int<Real> by_lane[lanes<Real>];
        store(by_lane, number);
        return by_lane[lane];
    }
    /// The first active lane is mostly lane 0, which the compiler extracts without going through
    /// memory.
    static lane_int<Real> first_of(const vint<Real>& number, std::uint32_t active)
    {
        return (active & 1u) != 0 ? lane_of(number, 0) : lane_of(number, __builtin_ctz(active));
    }

    vint<Real> number_;
    std::uint32_t left_;
    lane_int<Real> value_;
};

/// Calls `visit(number, lanes)` for each distinct number among the lanes of `active`.
template <class Real, class Visit>
inline void for_each_distinct(const vint<Real>& number, std::uint32_t active, const Visit& visit)
{
    if (active == 0)
        return;
    DistinctNumbers<Real> distinct(number, active);
    do
        visit(distinct.value(), distinct.lanes_of());
    while (distinct.next());
}

template <int Fields, class Real>
struct RecordPacket {
    vreal<Real> field[static_cast<std::size_t>(Fields)];

    Vec3v<Real> vector(int first) const
    {
        return {field[first], field[first + 1], field[first + 2]};
    }
};

/// The same record in all lanes. The fields are loaded one by one, not in a loop, so that the
/// compiler omits the fields that are not used.
template <class Real, std::size_t... Field>
inline RecordPacket<sizeof...(Field), Real> broadcast_record(const Real* record,
                                                             std::index_sequence<Field...>)
{
    return {{vreal<Real>(record[Field])...}};
}

template <int Fields, class Real, std::size_t... Field>
inline void blend_record(RecordPacket<Fields, Real>& records, const vmask<Real>& active,
                         const Real* record, std::index_sequence<Field...>)
{
    ((records.field[Field] = select(active, vreal<Real>(record[Field]), records.field[Field])),
     ...);
}

/// The record that `find(number)` returns, per lane: a struct of `Fields` reals. Inactive lanes
/// hold any record. Mostly there is only one number.
template <int Fields, class Real, class Find>
inline RecordPacket<Fields, Real> find_records(const vint<Real>& number, std::uint32_t active,
                                               const Find& find)
{
    constexpr std::make_index_sequence<static_cast<std::size_t>(Fields)> fields;
    DistinctNumbers<Real> distinct(number, active);
    const auto& first = find(distinct.value());
    static_assert(sizeof first == Fields * sizeof(Real));
    RecordPacket<Fields, Real> records =
        broadcast_record(reinterpret_cast<const Real*>(&first), fields);
    while (distinct.next()) {
        const auto& record = find(distinct.value());
        blend_record(records, distinct.lanes_of(), reinterpret_cast<const Real*>(&record), fields);
    }
    return records;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
