#pragma once

#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>
#include "reference/canvas.hpp"
#include "reference/paint.hpp"
#include "reference/surfaces/bodies.hpp"

#include <limits>
#include <vector>

namespace packtrace::reference {

template <class Real>
inline constexpr Real infinity = std::numeric_limits<Real>::infinity();

template <class Real>
struct LightSource {
    LightType type = LightType::ambient;
    Color<Real> intensity;
    Vec3<Real> vector;  ///< a point light's position, or the way to a directional light
    Vec3<Real> unit;    ///< the way to a directional light, normalised
    int number = 0;     ///< in Scene::lights
    bool casts_shadow = true;
};

/// What every note needs of a scene, converted once to the precision of the reference.
template <class Real>
struct World {
    Bodies<Real> bodies;
    Bodies<Real> blockers;            ///< those that cast shadows
    std::vector<Paint<Real>> paints;  ///< by object number
    std::vector<LightSource<Real>> lights;
    Color<Real> ambient;  ///< sum of the ambient lights
    Color<Real> background;
    ShadowKind shadows;
    int max_depth;
    Real min_weight;
    Canvas<Real> canvas;
    SelfHits self_hits;

    explicit World(const Scene& scene, SelfHits self_hits = default_self_hits);
};

}  // namespace packtrace::reference
