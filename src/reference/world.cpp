#include "reference/world.hpp"

namespace packtrace::reference {

template <class Real>
World<Real>::World(const Scene& scene, SelfHits rule)
    : bodies(scene, rule),
      blockers(scene, rule, [](const Object& object) { return object.casts_shadow; }),
      background(scene.background),
      shadows(scene.shadows),
      max_depth(scene.max_depth),
      min_weight(static_cast<Real>(scene.min_weight)),
      canvas(scene),
      self_hits(rule)
{
    for (const Object& object : scene.objects)
        paints.push_back(make_paint<Real>(object));
    for (const Light& light : scene.lights) {
        const Vec3<Real> vector(light.vector);
        const bool directional = light.type == LightType::directional;
        lights.push_back({light.type, Color<Real>(light.intensity), vector,
                          directional ? normalize(vector) : Vec3<Real>(),
                          static_cast<int>(lights.size()), light.casts_shadow});
        if (light.type == LightType::ambient)
            ambient += Color<Real>(light.intensity);
    }
}

template struct World<float>;
template struct World<double>;
template struct World<long double>;

}  // namespace packtrace::reference
