#include "reference/models/general.hpp"

#include "reference/shadow.hpp"

#include <cmath>

namespace packtrace::reference {

template <class Real, class Recorder>
General<Real, Recorder>::General(const Scene& scene, const World<Real>& world, Recorder record)
    : record_(record), world_(world)
{
    for (const Object& object : scene.objects) {
        const auto& from = model_of<GeneralMaterial>(object);
        coefficients_.push_back({Color<Real>(from.ambient), Color<Real>(from.diffuse),
                                 Color<Real>(from.highlight), Color<Real>(from.reflect),
                                 Color<Real>(from.transmit), static_cast<Real>(from.shininess)});
        glass_.bodies.push_back({Color<Real>(from.transmit), static_cast<Real>(from.ior)});
    }
    around_eye_ = glass_.stack_at(world.bodies, world.canvas.position, world.canvas.forward);
    if (scene.depth_limit == DepthLimit::background)
        at_limit_ = world.background;
}

template <class Real, class Recorder>
Color<Real> General<Real, Recorder>::intensity(const Ray<Real>& ray, int depth,
                                               const RayWeight<Real>& weight) const
{
    const auto traced = record_.ray(ray.org, ray.dir);
    const auto at = closest_surface(world_, ray);
    if (!at)
        return record_.miss(world_.background);
    record_.hit(at->t, at->object, at->P, at->N);
    const Coefficients& k = coefficients_[static_cast<std::size_t>(at->object)];
    Color<Real> sum = record_.local(local(k, *at, -ray.dir));

    const auto refracted = any_positive(k.kt) ? glass_.refraction_ray(ray, *at) : std::nullopt;
    // Total internal reflection moves kt's share to the reflected ray.
    const Color<Real> kr = refracted ? k.kr : k.kr + k.kt;
    if (any_positive(kr)) {
        record_.mirrored(kr);
        sum += kr * child(reflection_ray(ray, *at), depth, weight.of_child(kr));
    }
    if (refracted) {
        record_.refracted(k.kt);
        sum += k.kt * child(*refracted, depth, weight.of_child(k.kt));
    }
    return sum;
}

// A ray below Scene::min_weight brings no light. Beyond the depth limit no ray would be traced.
template <class Real, class Recorder>
Color<Real> General<Real, Recorder>::child(const Ray<Real>& ray, int depth,
                                           const RayWeight<Real>& weight) const
{
    if (depth <= 0)
        return record_.limit(at_limit_);
    return is_cut(world_, weight, world_.max_depth - depth + 1) ? Color<Real>()
                                                                : intensity(ray, depth - 1, weight);
}

template <class Real, class Recorder>
Color<Real> General<Real, Recorder>::local(const Coefficients& k, const SurfacePoint<Real>& at,
                                           const Vec3<Real>& V) const
{
    Color<Real> sum = k.ka * world_.ambient;
    for (const LightSource<Real>& light : world_.lights) {
        if (light.type == LightType::ambient)
            continue;
        const WayToLight<Real> way = way_to_light(light, at.P);
        const Color<Real> s = record_.share(light.number, light_share(world_, glass_, at, way));
        if (!any_positive(s))
            continue;
        // A light behind the surface adds nothing.
        const Real n_dot_l = dot(at.N, way.L);
        if (!(n_dot_l > 0))
            continue;
        const Real r_dot_v = dot(reflect_ray(way.L, at.N), V);
        const Real highlight = r_dot_v > 0 ? std::pow(r_dot_v, k.n) : Real(0);
        sum += record_.adds(s * light.intensity * (k.kd * n_dot_l + k.ks * highlight));
    }
    return sum;
}

template <class Real, class Recorder>
Color<Real> General<Real, Recorder>::trace_ray(const Vec3<Real>& org, const Vec3<Real>& dir,
                                               const RayWeight<Real>& weight) const
{
    return intensity({org, normalize(dir), around_eye_}, world_.max_depth, weight);
}

template class General<float>;
template class General<double>;
template class General<long double>;
template class General<float, TreeRecorder>;
template class General<double, TreeRecorder>;

}  // namespace packtrace::reference
