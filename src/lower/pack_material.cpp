#include "lower/pack_material.hpp"

#include <cmath>
#include <limits>

#include "geometry/round_to.hpp"

namespace packtrace {
namespace {

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

template abi::MaterialRecord<float> pack_material(const LoweredMaterial&);
template abi::MaterialRecord<double> pack_material(const LoweredMaterial&);

}  // namespace packtrace
