#pragma once

#include "kernels/stats/work_counts.hpp"

// The hooks that count unsure rays by cause.
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

/// In the lanes of `lowered`, the surface `number` may be hit before the hit that is kept. -1 means
/// the end of the range.
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

/// In the lanes of `lowered`, a hit may come before the one that is kept. In the lanes of `at_end`
/// it exists but may be before t_min; in the others it may not exist.
template <class Real>
inline void note_doubt(const vmask<Real>& lowered, std::uint32_t at_end)
{
    note_rival<Real>(lowered, select(from_bits<Real>(at_end & all_lanes<Real>),
                                     vint<Real>(rival_for(abi::Cause::range)),
                                     vint<Real>(rival_for(abi::Cause::tangent))));
}

/// Nothing is known of the lanes in `lowered`.
template <class Real>
inline void note_magnitude(const vmask<Real>& lowered)
{
    note_rival<Real>(lowered, vint<Real>(rival_for(abi::Cause::magnitude)));
}

/// note_rival() for one ray of a bundle.
inline void note_rival_of_ray(int ray, std::int32_t number)
{
    observer.rival_of_ray[ray] = number;
}
/// The value that note_doubt() records for a hit that may be before t_min (`at_end`), or may not
/// exist.
inline std::int32_t rival_in_doubt(bool at_end)
{
    return rival_for(at_end ? abi::Cause::range : abi::Cause::tangent);
}

/// Call these where a packet of a bundle is loaded and stored. Rays in double are never unsure.
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

/// Call these where one ray of a bundle is loaded as a packet and stored.
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

/// An object may occlude the lanes of `unsure`. Lanes with too large or small magnitudes are
/// recorded before all other causes of a packet, and keep that cause.
inline void note_in_the_way(std::uint32_t unsure, abi::Cause cause)
{
    if (cause == abi::Cause::magnitude)
        observer.beyond = unsure;
    else
        unsure &= ~observer.beyond;
    for (; unsure != 0; unsure &= unsure - 1)
        observer.noted[__builtin_ctz(unsure)] = cause;
}

/// Copies the causes of lanes to the rays of the packet at `first` of a bundle.
inline void keep_noted(int first, std::uint32_t unsure)
{
    observer.beyond = 0;
    for (; unsure != 0; unsure &= unsure - 1)
        observer.noted_of_ray[first + __builtin_ctz(unsure)] =
            observer.noted[__builtin_ctz(unsure)];
}

/// Copies the cause of any lane of `unsure` to one ray of a bundle.
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

/// The cause for which either of two surfaces may be hit first. `object_of(surface)` is the object
/// of a surface.
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

/// Counts lanes of a packet that are unsure of their closest hits, which are on `surface` so far.
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

/// The same for one ray of a bundle.
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

/// Counts the shadow rays of a packet, or one of a bundle, that are unsure of being occluded.
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

/// Counts an unsure ray that double cannot decide either.
inline void count_undecided(int ray)
{
    ++pixel_of(observer.first + ray).undecided;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
