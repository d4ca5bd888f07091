#pragma once

#include "kernels/simd/vec3.hpp"

#include <utility>

// Per-lane look-up of records by number. Neighbouring rays mostly ask for the same record, so
// each distinct one is loaded once and blended into its lanes: no gathers.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The distinct numbers among some lanes, of which there is at least one: a cursor.
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
    /// The lanes of value(), inactive ones among them.
    [[nodiscard]] vmask<Real> lanes_of() const
    {
        return int_equal(number_, vint<Real>(value_));
    }
    /// Whether there is but one.
    [[nodiscard]] bool is_only() const
    {
        return (left_ & ~bits(lanes_of())) == 0;
    }
    /// Goes on to the next; false when there is none.
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
    /// Mostly lane 0, which the compiler takes without a way through memory.
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

/// The same record in all lanes. Field by field without a loop, so that those that nobody asks
/// for are not loaded.
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

/// Per lane the record that `find(number)` returns, a struct of `Fields` reals; inactive lanes
/// hold some record. Mostly there is but one.
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
