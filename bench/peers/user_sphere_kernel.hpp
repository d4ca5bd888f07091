#pragma once

#include "user_sphere.hpp"

#include <cmath>
#include <limits>

// The callbacks for lanes of any width. The source of each instruction set includes this once and
// defines `Lanes`, with a vector V, a mask M and the operations used here.
namespace packtrace::peers {
namespace {

// What all lanes have in common: their intrinsics differ only in the prefix.
#define PACKTRACE_LANES_ARITHMETIC(count, Vector, p) \
    using V = Vector;                                \
    static constexpr int width = count;              \
    static V set(float x)                            \
    {                                                \
        return p##_set1_ps(x);                       \
    }                                                \
    static V load(const float* x)                    \
    {                                                \
        return p##_load_ps(x);                       \
    }                                                \
    static V add(V x, V y)                           \
    {                                                \
        return p##_add_ps(x, y);                     \
    }                                                \
    static V sub(V x, V y)                           \
    {                                                \
        return p##_sub_ps(x, y);                     \
    }                                                \
    static V mul(V x, V y)                           \
    {                                                \
        return p##_mul_ps(x, y);                     \
    }                                                \
    static V div(V x, V y)                           \
    {                                                \
        return p##_div_ps(x, y);                     \
    }                                                \
    static V sqrt(V x)                               \
    {                                                \
        return p##_sqrt_ps(x);                       \
    }                                                \
    static V madd(V x, V y, V z)                     \
    {                                                \
        return p##_fmadd_ps(x, y, z);                \
    }                                                \
    static V msub(V x, V y, V z)                     \
    {                                                \
        return p##_fmsub_ps(x, y, z);                \
    }

/// The t of both hits of rays with a sphere. The discriminant is computed from the cross product,
/// which is more exact for far spheres.
template <class Lanes>
struct Roots {
    typename Lanes::M real;
    typename Lanes::V near;
    typename Lanes::V far;
};

template <class Lanes>
Roots<Lanes> roots_of(const SphereRecord& sphere, const float* ray, typename Lanes::M active)
{
    using V = typename Lanes::V;
    constexpr int n = Lanes::width;
    const V way_x = Lanes::sub(Lanes::set(sphere.center[0]), Lanes::load(ray + 0 * n));
    const V way_y = Lanes::sub(Lanes::set(sphere.center[1]), Lanes::load(ray + 1 * n));
    const V way_z = Lanes::sub(Lanes::set(sphere.center[2]), Lanes::load(ray + 2 * n));
    const V dir_x = Lanes::load(ray + 4 * n);
    const V dir_y = Lanes::load(ray + 5 * n);
    const V dir_z = Lanes::load(ray + 6 * n);
    const V cross_x = Lanes::msub(way_y, dir_z, Lanes::mul(way_z, dir_y));
    const V cross_y = Lanes::msub(way_z, dir_x, Lanes::mul(way_x, dir_z));
    const V cross_z = Lanes::msub(way_x, dir_y, Lanes::mul(way_y, dir_x));
    const V square =
        Lanes::madd(cross_x, cross_x, Lanes::madd(cross_y, cross_y, Lanes::mul(cross_z, cross_z)));
    const V a = Lanes::madd(dir_x, dir_x, Lanes::madd(dir_y, dir_y, Lanes::mul(dir_z, dir_z)));
    const V discriminant = Lanes::msub(a, Lanes::set(sphere.radius * sphere.radius), square);
    Roots<Lanes> roots;
    roots.real = Lanes::both(active, Lanes::not_less(discriminant, Lanes::set(0.0F)));
    if (!Lanes::any(roots.real))
        return roots;
    const V b = Lanes::madd(way_x, dir_x, Lanes::madd(way_y, dir_y, Lanes::mul(way_z, dir_z)));
    const V inverse = Lanes::div(Lanes::set(1.0F), a);
    const V root = Lanes::sqrt(discriminant);
    roots.near = Lanes::mul(Lanes::sub(b, root), inverse);
    roots.far = Lanes::mul(Lanes::add(b, root), inverse);
    return roots;
}

template <class Lanes>
typename Lanes::M within(typename Lanes::V t, const float* ray)
{
    constexpr int n = Lanes::width;
    return Lanes::both(Lanes::less(Lanes::load(ray + 3 * n), t),
                       Lanes::less(t, Lanes::load(ray + 8 * n)));
}

template <class Lanes>
void intersect_lanes(const RTCIntersectFunctionNArguments& args)
{
    constexpr int n = Lanes::width;
    auto* ray = reinterpret_cast<float*>(args.rayhit);
    const auto& sphere = static_cast<const SphereRecord*>(args.geometryUserPtr)[args.primID];
    const auto roots = roots_of<Lanes>(sphere, ray, Lanes::active(args.valid));
    if (!Lanes::any(roots.real))
        return;
    const auto near = within<Lanes>(roots.near, ray);
    const auto hit = Lanes::both(roots.real, Lanes::either(near, within<Lanes>(roots.far, ray)));
    if (!Lanes::any(hit))
        return;
    Lanes::store(ray + 8 * n, hit, Lanes::select(near, roots.near, roots.far));
    // After the ray's twelve components come the normal, u and v, which are not read.
    auto* prim = reinterpret_cast<int*>(ray + 17 * n);
    Lanes::store(prim, hit, static_cast<int>(args.primID));
    Lanes::store(prim + n, hit, static_cast<int>(args.geomID));
}

template <class Lanes>
void occlude_lanes(const RTCOccludedFunctionNArguments& args)
{
    auto* ray = reinterpret_cast<float*>(args.ray);
    const auto& sphere = static_cast<const SphereRecord*>(args.geometryUserPtr)[args.primID];
    const auto roots = roots_of<Lanes>(sphere, ray, Lanes::active(args.valid));
    if (!Lanes::any(roots.real))
        return;
    const auto hit = Lanes::both(
        roots.real, Lanes::either(within<Lanes>(roots.near, ray), within<Lanes>(roots.far, ray)));
    Lanes::store(ray + 8 * Lanes::width, hit, Lanes::set(-std::numeric_limits<float>::infinity()));
}

/// Both t of one lane, for packets of other widths.
struct Distances {
    bool real;
    float near;
    float far;
};

inline Distances roots_of_one(const SphereRecord& sphere, const float* ray, unsigned n, unsigned i)
{
    const float way[3] = {sphere.center[0] - ray[i], sphere.center[1] - ray[n + i],
                          sphere.center[2] - ray[2 * n + i]};
    const float dir[3] = {ray[4 * n + i], ray[5 * n + i], ray[6 * n + i]};
    const float cross[3] = {way[1] * dir[2] - way[2] * dir[1], way[2] * dir[0] - way[0] * dir[2],
                            way[0] * dir[1] - way[1] * dir[0]};
    const float a = dir[0] * dir[0] + dir[1] * dir[1] + dir[2] * dir[2];
    const float square = cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2];
    const float discriminant = a * sphere.radius * sphere.radius - square;
    if (!(discriminant >= 0.0F))
        return {false, 0.0F, 0.0F};
    const float b = way[0] * dir[0] + way[1] * dir[1] + way[2] * dir[2];
    const float inverse = 1.0F / a;
    const float root = std::sqrt(discriminant);
    return {true, (b - root) * inverse, (b + root) * inverse};
}

inline bool within_one(float t, const float* ray, unsigned n, unsigned i)
{
    return ray[3 * n + i] < t && t < ray[8 * n + i];
}

inline void intersect_any(const RTCIntersectFunctionNArguments& args)
{
    const unsigned n = args.N;
    auto* ray = reinterpret_cast<float*>(args.rayhit);
    const auto& sphere = static_cast<const SphereRecord*>(args.geometryUserPtr)[args.primID];
    for (unsigned i = 0; i < n; ++i) {
        if (args.valid[i] == 0)
            continue;
        const Distances t = roots_of_one(sphere, ray, n, i);
        const bool near = t.real && within_one(t.near, ray, n, i);
        if (!near && !(t.real && within_one(t.far, ray, n, i)))
            continue;
        ray[8 * n + i] = near ? t.near : t.far;
        auto* ids = reinterpret_cast<unsigned*>(ray);
        ids[17 * n + i] = args.primID;
        ids[18 * n + i] = args.geomID;
    }
}

inline void occlude_any(const RTCOccludedFunctionNArguments& args)
{
    const unsigned n = args.N;
    auto* ray = reinterpret_cast<float*>(args.ray);
    const auto& sphere = static_cast<const SphereRecord*>(args.geometryUserPtr)[args.primID];
    for (unsigned i = 0; i < n; ++i) {
        if (args.valid[i] == 0)
            continue;
        const Distances t = roots_of_one(sphere, ray, n, i);
        if (t.real && (within_one(t.near, ray, n, i) || within_one(t.far, ray, n, i)))
            ray[8 * n + i] = -std::numeric_limits<float>::infinity();
    }
}

/// With vectors for packets as wide as one of `Lanes`, else ray by ray.
template <class... Lanes>
void intersect_widths(const RTCIntersectFunctionNArguments* args)
{
    const bool done = ((args->N == Lanes::width && (intersect_lanes<Lanes>(*args), true)) || ...);
    if (!done)
        intersect_any(*args);
}

template <class... Lanes>
void occlude_widths(const RTCOccludedFunctionNArguments* args)
{
    const bool done = ((args->N == Lanes::width && (occlude_lanes<Lanes>(*args), true)) || ...);
    if (!done)
        occlude_any(*args);
}

}  // namespace
}  // namespace packtrace::peers
