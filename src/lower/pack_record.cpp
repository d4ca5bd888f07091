#include "lower/pack_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

namespace packtrace {
namespace {

template <class Real>
Vec3 widen(const Real (&from)[3])
{
    return {from[0], from[1], from[2]};
}

/// Below this cosine the highlight is less than the smallest normal number and counts as 0; a
/// little lower, so that the kernel's own power is 0 there too.
template <class Real>
Real highlight_floor(const LoweredMaterial& material)
{
    if (material.highlight == Rgb(0.0))
        return std::numeric_limits<Real>::infinity();
    const double smallest = std::numeric_limits<Real>::min_exponent - 1;
    return static_cast<Real>(std::exp2(smallest / material.shininess) * (1.0 - 1e-6));
}

}  // namespace

template <class Real>
double center_error(const LoweredSphere& sphere)
{
    Real rounded[3];
    round_to(rounded, sphere.center);
    return 1.000001 * glm::length(widen(rounded) - sphere.center);
}

/// The curvature form around the anchor as rounded: what rounding moved goes into the offset.
template <class Real>
abi::AnchoredSphere<Real> pack_anchored(const LoweredAnchoredSphere& sphere)
{
    abi::AnchoredSphere<Real> packed;
    round_to(packed.anchor, sphere.anchor);
    const Vec3 outwards = widen(packed.anchor) - sphere.center;
    const double distance = glm::length(outwards);
    round_to(packed.normal, outwards / sphere.radius);
    packed.curvature = static_cast<Real>(1.0 / sphere.radius);
    packed.offset =
        static_cast<Real>((distance - sphere.radius) * (distance + sphere.radius) / sphere.radius);
    round_to(packed.center, sphere.center);
    packed.radius = static_cast<Real>(sphere.radius);
    packed.surface = sphere.surface;
    return packed;
}

template <class Real>
abi::PlaneRecord<Real> pack_plane(const LoweredPlane& plane)
{
    abi::PlaneRecord<Real> packed;
    round_to(packed.point, plane.point);
    round_to(packed.normal, plane.normal);
    packed.surface = plane.surface;
    return packed;
}

template <class Real>
abi::MaterialRecord<Real> pack_material(const LoweredMaterial& material)
{
    abi::MaterialRecord<Real> packed;
    round_to(packed.ambient, material.ambient);
    round_to(packed.diffuse, material.diffuse);
    round_to(packed.highlight, material.highlight);
    round_to(packed.reflect, material.reflect);
    round_to(packed.local, material.local);
    round_to(packed.transmit, material.transmit);
    packed.shininess = static_cast<Real>(material.shininess);
    packed.highlight_floor = highlight_floor<Real>(material);
    return packed;
}

template <class Real>
abi::QuadricRecord<Real> pack_quadric(const LoweredQuadric& quadric)
{
    abi::QuadricRecord<Real> packed;
    round_to(packed.center, quadric.center);
    round_to(packed.center_low, quadric.center - widen(packed.center));
    for (int row = 0; row < 3; ++row)
        round_to(packed.inverse[row], glm::row(quadric.inverse, row));
    round_to(packed.square, quadric.square);
    packed.linear = static_cast<Real>(quadric.linear);
    packed.constant = static_cast<Real>(quadric.constant);
    round_to(packed.clip, quadric.clip);
    packed.clip_offset = static_cast<Real>(quadric.clip_offset);
    packed.clip_low = static_cast<Real>(quadric.clip_low);
    packed.clip_high = static_cast<Real>(quadric.clip_high);
    round_to(packed.bound, quadric.bound);
    packed.bound_radius = static_cast<Real>(quadric.bound_radius);
    packed.clipped = quadric.clipped() ? 1 : 0;
    packed.capped = quadric.capped ? 1 : 0;
    packed.surface = quadric.surface;
    return packed;
}

template double center_error<float>(const LoweredSphere&);
template double center_error<double>(const LoweredSphere&);
template abi::AnchoredSphere<float> pack_anchored(const LoweredAnchoredSphere&);
template abi::AnchoredSphere<double> pack_anchored(const LoweredAnchoredSphere&);
template abi::PlaneRecord<float> pack_plane(const LoweredPlane&);
template abi::PlaneRecord<double> pack_plane(const LoweredPlane&);
template abi::QuadricRecord<float> pack_quadric(const LoweredQuadric&);
template abi::QuadricRecord<double> pack_quadric(const LoweredQuadric&);
template abi::MaterialRecord<float> pack_material(const LoweredMaterial&);
template abi::MaterialRecord<double> pack_material(const LoweredMaterial&);

}  // namespace packtrace
