#pragma once

#include "kernel_abi/onedim_table.hpp"
#include "onedim/bit_transpose.hpp"

#include <cstddef>
#include <cstdint>

// The one-dimensional note on bit planes. From the far end to the eye, every surface turns the
// transfer function of what lies beyond it (L as a function of R) into the one before it; no
// iteration is needed (docs/onedim.md).
namespace packtrace::PACKTRACE_ISA {
namespace {
namespace onedim {

/// An intensity in every bit position: none, `some` only for Medium, both for All.
struct Level {
    vbits some;
    vbits all;
};

inline Level operator+(const Level& a, const Level& b)
{
    return {a.some | b.some, a.all | b.all | (a.some & b.some)};
}

inline Level operator*(const Level& a, const Level& b)
{
    return {a.some & b.some, a.all & b.all};
}

inline Level select(const vbits& chosen, const Level& a, const Level& b)
{
    return {(a.some & chosen) | (b.some & ~chosen), (a.all & chosen) | (b.all & ~chosen)};
}

/// L for each R; monotone.
struct Transfer {
    Level for_none;
    Level for_medium;
    Level for_all;
};

inline Level apply(const Transfer& f, const Level& x)
{
    return {f.for_none.some | (x.some & f.for_medium.some) | (x.all & f.for_all.some),
            f.for_none.all | (x.some & f.for_medium.all) | (x.all & f.for_all.all)};
}

struct Surface {
    vbits away;
    Level reflectance;
    Level translucence;
    Level emission;
};

// Facing the eye: L = r R + t L' + e, and R' = R beyond.
inline Transfer facing_towards(const Surface& s, const Transfer& beyond)
{
    const vbits zero{};
    const Level& r = s.reflectance;
    const Level& t = s.translucence;
    return {t * beyond.for_none + s.emission,
            Level{r.some, zero} + t * beyond.for_medium + s.emission,
            r + t * beyond.for_all + s.emission};
}

// Facing away: L = L', and R' is the least y = r f(y) + c with c = t R + e. It is not None if
// f(None) or c lights it, and All if besides f(Medium) and c make it so.
inline Level reflected(const Surface& s, const Transfer& beyond, const Level& c)
{
    const vbits some = c.some | (s.reflectance.some & beyond.for_none.some);
    const Level once_more = s.reflectance * beyond.for_medium + c;
    return {some, some & once_more.all};
}

inline Transfer facing_away(const Surface& s, const Transfer& beyond)
{
    const Level& t = s.translucence;
    const vbits zero{};
    const Level& e = s.emission;
    return {apply(beyond, reflected(s, beyond, e)),
            apply(beyond, reflected(s, beyond, Level{t.some, zero} + e)),
            apply(beyond, reflected(s, beyond, t + e))};
}

inline Transfer step(const Surface& s, const Transfer& beyond)
{
    const Transfer towards = facing_towards(s, beyond);
    const Transfer away = facing_away(s, beyond);
    return {select(s.away, away.for_none, towards.for_none),
            select(s.away, away.for_medium, towards.for_medium),
            select(s.away, away.for_all, towards.for_all)};
}

inline vbits load_plane(const std::uint64_t* planes, int plane)
{
    return load_bits(planes + plane * register_words);
}

// Numbers 0, 1, 2 in two planes; 2 has only the high bit.
inline Level load_number(const std::uint64_t* planes, int low)
{
    const vbits high = load_plane(planes, low + 1);
    return {load_plane(planes, low) | high, high};
}

inline Surface load_surface(const std::uint64_t* planes)
{
    return {load_plane(planes, 0), load_number(planes, 1), load_number(planes, 3),
            load_number(planes, 5)};
}

inline Level load_level(const std::uint64_t* planes, int plane)
{
    return {load_plane(planes, plane), load_plane(planes, plane + 1)};
}

inline void store_level(std::uint64_t* planes, int plane, const Level& x)
{
    store_bits(planes + plane * register_words, x.some);
    store_bits(planes + (plane + 1) * register_words, x.all);
}

inline void solve(const abi::OnedimRun& run)
{
    constexpr std::size_t surface_words = abi::onedim_planes * register_words;
    Transfer f{load_level(run.state, 0), load_level(run.state, 2), load_level(run.state, 4)};
    for (std::size_t i = run.surfaces; i-- > 0;)
        f = step(load_surface(run.planes + i * surface_words), f);
    store_level(run.state, 0, f.for_none);
    store_level(run.state, 2, f.for_medium);
    store_level(run.state, 4, f.for_all);
}

inline void transpose(std::uint64_t* tiles, std::size_t count)
{
    for (std::size_t tile = 0; tile < count; ++tile)
        transpose_bits(tiles + tile * matrix_rows * register_words);
}

inline constexpr abi::OnedimTable table = {register_words, transpose, solve};

}  // namespace onedim
}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
