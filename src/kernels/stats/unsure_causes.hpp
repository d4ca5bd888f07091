#pragma once

#include "kernels/stats/work_counts.hpp"

// The hooks that count unsure rays, by what makes them so.
namespace packtrace::PACKTRACE_ISA {
namespace {

inline bool names_causes()
{
    return observer.counts != nullptr;
}

constexpr std::int32_t rival_for(abi::Cause cause)
{
    return -2 - static_cast<std::int32_t>(cause);
}

/// The surface `number` may come before what the lanes of `lowered` hit; -1 is the range's end.
template <class Real>
inline void note_rival(const vmask<Real>& lowered, const vint<Real>& number)
{
    if (!names_causes())
        return;
    alignas(64) std::int32_t numbers[lanes<float>];
    store(numbers, number);
    for (std::uint32_t left = bits(lowered); left != 0; left &= left - 1)
        observer.rival[__builtin_ctz(left)] = numbers[__builtin_ctz(left)];
}

/// Something may come before it: of the lanes of `at_end` a hit that may be before t_min, of the
/// others one that may not be.
template <class Real>
inline void note_doubt(const vmask<Real>& lowered, std::uint32_t at_end)
{
    note_rival<Real>(lowered, select(from_bits<Real>(at_end & all_lanes<Real>),
                                     vint<Real>(rival_for(abi::Cause::range)),
                                     vint<Real>(rival_for(abi::Cause::tangent))));
}

/// Nothing is known of the lanes.
template <class Real>
inline void note_magnitude(const vmask<Real>& lowered)
{
    note_rival<Real>(lowered, vint<Real>(rival_for(abi::Cause::magnitude)));
}

/// The same of one ray of a bundle.
inline void note_rival_of_ray(int ray, std::int32_t number)
{
    observer.rival_of_ray[ray] = number;
}
/// What note_doubt() has of a hit that may be before t_min, or may not be.
inline std::int32_t rival_in_doubt(bool at_end)
{
    return rival_for(at_end ? abi::Cause::range : abi::Cause::tangent);
}

/// A packet of a bundle is taken up, or put back. What doubles have is never in doubt.
template <class Real>
inline void load_rivals(int first)
{
    if constexpr (sizeof(Real) == sizeof(float))
        for (int lane = 0; lane < lanes<float> && names_causes(); ++lane)
            observer.rival[lane] = observer.rival_of_ray[first + lane];
}
template <class Real>
inline void store_rivals(int first)
{
    if constexpr (sizeof(Real) == sizeof(float))
        for (int lane = 0; lane < lanes<float> && names_causes(); ++lane)
            observer.rival_of_ray[first + lane] = observer.rival[lane];
}

/// One ray of a bundle is taken up as a packet, or put back.
template <class Real>
inline void load_rival_of_ray(int ray)
{
    if constexpr (sizeof(Real) == sizeof(float))
        for (int lane = 0; lane < lanes<float>; ++lane)
            observer.rival[lane] = observer.rival_of_ray[ray];
}
template <class Real>
inline void store_rival_of_ray(int ray)
{
    if constexpr (sizeof(Real) == sizeof(float))
        observer.rival_of_ray[ray] = observer.rival[0];
}

/// Something may be in the way of the lanes of `unsure`. Those that no bound holds for are told of
/// before all others of a packet, and keep that cause.
inline void note_in_the_way(std::uint32_t unsure, abi::Cause cause)
{
    if (cause == abi::Cause::magnitude)
        observer.beyond = unsure;
    else
        unsure &= ~observer.beyond;
    for (; unsure != 0; unsure &= unsure - 1)
        observer.noted[__builtin_ctz(unsure)] = cause;
}

/// What was noted of lanes is so of the rays of the packet at `first` of a bundle.
inline void keep_noted(int first, std::uint32_t unsure)
{
    observer.beyond = 0;
    for (; unsure != 0; unsure &= unsure - 1)
        observer.noted_of_ray[first + __builtin_ctz(unsure)] =
            observer.noted[__builtin_ctz(unsure)];
}

/// What was noted of any lane of `unsure` is so of one ray of a bundle.
inline void keep_noted_of_ray(int ray, std::uint32_t unsure)
{
    observer.noted_of_ray[ray] = observer.noted[__builtin_ctz(unsure)];
}

inline void count_unsure(abi::Cause cause, int ray)
{
    if (observer.counts != nullptr)
        ++observer.counts->unsure[index(observer.purpose)][index(cause)];
    if (counts_pixels())
        ++pixel_of(ray).unsure;
}

/// Why nothing tells which of two comes first; `object_of(surface)` is a surface's object.
template <class ObjectOf>
inline abi::Cause cause_of(std::int32_t surface, std::int32_t rival, const ObjectOf& object_of)
{
    if (rival < -1)
        return static_cast<abi::Cause>(-2 - rival);
    if (rival < 0 || surface < 0)
        return abi::Cause::range;
    if (rival == surface)
        return abi::Cause::tangent;
    return object_of(rival) == object_of(surface) ? abi::Cause::clip : abi::Cause::order;
}

/// Lanes of the packet are unsure of their closest hits, which are so far on `surface`.
template <class ObjectOf>
inline void count_unsure_lanes(std::uint32_t unsure, const lane_int<float>* surface,
                               const ObjectOf& object_of)
{
    if (observer.to == nullptr)
        return;
    for (; unsure != 0; unsure &= unsure - 1) {
        const int lane = __builtin_ctz(unsure);
        const abi::Cause cause = names_causes()
                                     ? cause_of(surface[lane], observer.rival[lane], object_of)
                                     : abi::Cause::order;
        count_unsure(cause, observer.first + lane);
    }
}

/// The same of a ray of a bundle.
template <class ObjectOf>
inline void count_unsure_ray(int ray, std::int32_t surface, const ObjectOf& object_of)
{
    if (observer.to == nullptr)
        return;
    const abi::Cause cause = names_causes()
                                 ? cause_of(surface, observer.rival_of_ray[ray], object_of)
                                 : abi::Cause::order;
    count_unsure(cause, ray);
}

/// Shadow rays of a packet, or of a bundle, are unsure of what is in their way.
inline void count_unsure_shadows(std::uint32_t unsure)
{
    if (observer.to != nullptr)
        for (; unsure != 0; unsure &= unsure - 1)
            count_unsure(observer.noted[__builtin_ctz(unsure)],
                         observer.first + __builtin_ctz(unsure));
}
inline void count_unsure_shadow(int ray)
{
    if (observer.to != nullptr)
        count_unsure(observer.noted_of_ray[ray], ray);
}

inline bool asks_for_undecided()
{
    return counts_pixels();
}

/// Double cannot decide about an unsure ray either.
inline void count_undecided(int ray)
{
    ++pixel_of(observer.first + ray).undecided;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
