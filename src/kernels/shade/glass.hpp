#pragma once

#include "kernels/shade/hit_points.hpp"

// Refraction through nested and overlapping glass bodies.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The medium stack of each ray: the glass bodies that it is inside of, by object number, the one
/// it travels in first. -1 fills the rest.
template <class Real>
struct GlassPacket {
    vint<Real> body[abi::glass_depth];
};

template <class Real>
inline vint<Real> no_body()
{
    return vint<Real>(lane_int<Real>(-1));
}

template <class Real>
inline std::uint32_t inside_of(const GlassPacket<Real>& glass, const vint<Real>& object)
{
    std::uint32_t found = 0;
    for (const vint<Real>& body : glass.body)
        found |= bits(int_equal(body, object));
    return found;
}

template <class Real>
inline GlassPacket<Real> entered(const GlassPacket<Real>& glass, const vint<Real>& object)
{
    GlassPacket<Real> result;
    result.body[0] = object;
    for (int i = 1; i < abi::glass_depth; ++i)
        result.body[i] = glass.body[i - 1];
    return result;
}

/// Removes `object`, wherever it is.
template <class Real>
inline GlassPacket<Real> left(const GlassPacket<Real>& glass, const vint<Real>& object)
{
    GlassPacket<Real> result;
    std::uint32_t passed = 0;
    for (int i = 0; i < abi::glass_depth; ++i) {
        passed |= bits(int_equal(glass.body[i], object));
        const vint<Real> next = i + 1 < abi::glass_depth ? glass.body[i + 1] : no_body<Real>();
        result.body[i] = select(from_bits<Real>(passed), next, glass.body[i]);
    }
    return result;
}

template <class Real>
inline GlassPacket<Real> select(std::uint32_t active, const GlassPacket<Real>& a,
                                const GlassPacket<Real>& b)
{
    const auto mask = from_bits<Real>(active);
    GlassPacket<Real> result;
    for (int i = 0; i < abi::glass_depth; ++i)
        result.body[i] = select(mask, a.body[i], b.body[i]);
    return result;
}

template <class Real>
struct RefractedPacket {
    Vec3v<Real> dir;
    GlassPacket<Real> inside;
    std::uint32_t total;  ///< lanes of total internal reflection, which have no refracted ray
};

template <class Real>
inline vreal<Real> iors_of(const abi::SceneView<Real>& scene, const vint<Real>& body,
                           std::uint32_t active)
{
    const auto ior = find_records<1, Real>(body, active, [&](lane_int<Real> number) -> const Real& {
        return scene.materials.ior[number];
    });
    return ior.field[0];
}

/// Snell's law, for unit directions and for normals on the side that the ray comes from. Entering a
/// body pushes it, and leaving the innermost body pops it. A ray goes straight on if it leaves a
/// body that is not the innermost, enters a body that it is in, or leaves a body that it is not in
/// (open surfaces).
template <class Real>
inline RefractedPacket<Real> refract(const abi::SceneView<Real>& scene,
                                     const SurfacePacket<Real>& surface,
                                     const GlassPacket<Real>& inside, std::uint32_t active)
{
    const std::uint32_t recorded = inside_of(inside, surface.object);
    const std::uint32_t full = ~bits(int_equal(inside.body[abi::glass_depth - 1], no_body<Real>()));
    const std::uint32_t enters = active & ~surface.leaving & ~recorded & ~full;
    const std::uint32_t leaves = active & surface.leaving & recorded;
    const std::uint32_t bends = enters | (leaves & bits(int_equal(inside.body[0], surface.object)));

    RefractedPacket<Real> result;
    result.inside = select(leaves, left(inside, surface.object), inside);
    result.inside = select(enters, entered(inside, surface.object), result.inside);
    const vreal<Real> ior_before = iors_of(scene, inside.body[0], active);
    const vreal<Real> ior_behind = iors_of(scene, result.inside.body[0], active);

    const vreal<Real> zero(Real(0));
    const vreal<Real> one(Real(1));
    const vreal<Real> eta = ior_before / ior_behind;
    const vreal<Real> scaled_in = eta * negated(dot(surface.normal, surface.dir));
    // 1 - eta² (1 - cos²), written so that a small cosine keeps its digits.
    const vreal<Real> cos_out2 = madd(scaled_in, scaled_in, (one - eta) * (one + eta));
    const vreal<Real> bend = scaled_in - sqrt(max(cos_out2, zero));
    const Vec3v<Real> bent = madd<Real>(bend, surface.normal, scale<Real>(eta, surface.dir));
    result.total = bends & bits(cos_out2 < zero);
    result.dir = select(from_bits<Real>(bends), bent, surface.dir);
    return result;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
