#include "lower/pack_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include "lower/pack_record.hpp"

namespace packtrace {
namespace {

abi::SurfaceForm unclipped(abi::MetAgain met_again)
{
    abi::SurfaceForm form{};
    form.clip_low = -std::numeric_limits<double>::infinity();
    form.clip_high = std::numeric_limits<double>::infinity();
    form.met_again = met_again;
    return form;
}

/// Where nothing is bent outwards, what is inside is convex.
bool convex(const LoweredQuadric& quadric)
{
    return quadric.square.x >= 0.0 && quadric.square.y >= 0.0 && quadric.square.z >= 0.0;
}

abi::SurfaceForm side_form(const LoweredQuadric& quadric)
{
    abi::SurfaceForm form =
        unclipped(convex(quadric) ? abi::MetAgain::from_inside : abi::MetAgain::from_anywhere);
    Mat3 diagonal(0.0);
    for (int axis = 0; axis < 3; ++axis)
        diagonal[axis][axis] = quadric.square[axis];
    const Mat3 curvature = glm::transpose(quadric.inverse) * diagonal * quadric.inverse;
    const Vec3 normal = quadric.linear * glm::row(quadric.inverse, 2);
    double scale = glm::length(normal);
    for (int axis = 0; axis < 3; ++axis)
        scale = std::max(scale, glm::length(curvature[axis]));

    round_to(form.anchor, quadric.center);
    round_to(form.normal, normal / scale);
    const double entries[6] = {curvature[0][0], curvature[1][1], curvature[2][2],
                               curvature[1][0], curvature[2][0], curvature[2][1]};
    for (int i = 0; i < 6; ++i)
        form.curvature[i] = entries[i] / scale;
    form.constant = quadric.constant / scale;
    if (quadric.clipped()) {
        round_to(form.clip, quadric.clip);
        form.clip_offset = quadric.clip_offset;
        form.clip_low = quadric.clip_low;
        form.clip_high = quadric.clip_high;
    }
    return form;
}

abi::SurfaceForm cap_form(const LoweredQuadric& quadric, bool high)
{
    abi::SurfaceForm form = unclipped(abi::MetAgain::never);
    const double scale = (high ? 1.0 : -1.0) / glm::length(quadric.clip);
    round_to(form.anchor, quadric.center);
    round_to(form.normal, 0.5 * scale * quadric.clip);
    form.constant = scale * (quadric.clip_offset - (high ? quadric.clip_high : quadric.clip_low));
    return form;
}

}  // namespace

abi::SurfaceForm pack_form(const LoweredSphere& sphere)
{
    abi::SurfaceForm form = unclipped(abi::MetAgain::from_inside);
    round_to(form.anchor, sphere.center);
    form.constant = -sphere.radius;
    std::fill_n(form.curvature, 3, 1.0 / sphere.radius);
    return form;
}

abi::SurfaceForm pack_form(const LoweredHugeSphere& sphere)
{
    abi::SurfaceForm form = unclipped(abi::MetAgain::from_inside);
    const auto huge = pack_huge<double>(sphere);
    std::copy(huge.anchor, huge.anchor + 3, form.anchor);
    std::copy(huge.normal, huge.normal + 3, form.normal);
    std::fill_n(form.curvature, 3, huge.curvature);
    form.constant = huge.offset;
    return form;
}

abi::SurfaceForm pack_form(const LoweredPlane& plane)
{
    abi::SurfaceForm form = unclipped(abi::MetAgain::never);
    round_to(form.anchor, plane.point);
    round_to(form.normal, plane.normal);
    return form;
}

abi::SurfaceForm pack_form(const LoweredQuadric& quadric, int piece)
{
    return piece == 0 ? side_form(quadric) : cap_form(quadric, piece == 2);
}

}  // namespace packtrace
