#include "reference/models/note_002.hpp"

#include "reference/shadow.hpp"

#include <cmath>

namespace packtrace::reference {

template <class Real, class Recorder>
Note002<Real, Recorder>::Note002(const Scene& scene, const World<Real>& world, Recorder record)
    : record_(record), world_(world)
{
    for (const Object& object : scene.objects) {
        const auto& from = model_of<WhittedMaterial>(object);
        constants_.push_back({Color<Real>(from.ambient), Color<Real>(from.diffuse),
                              Color<Real>(from.specular), Color<Real>(from.transmissive),
                              static_cast<Real>(from.shininess)});
        glass_.bodies.push_back({Color<Real>(from.transmissive), static_cast<Real>(from.ior)});
    }
    around_eye_ = glass_.stack_at(world.bodies, world.canvas.position, world.canvas.forward);
}

template <class Real, class Recorder>
Color<Real> Note002<Real, Recorder>::intensity(const Ray<Real>& ray, int depth,
                                               const RayWeight<Real>& weight) const
{
    const auto traced = record_.ray(ray.org, ray.dir);
    const auto at = closest_surface(world_, ray);
    if (!at)
        return record_.miss(world_.background);
    record_.hit(at->t, at->object, at->P, at->N);
    const auto object = static_cast<std::size_t>(at->object);
    const Constants& k = constants_[object];
    const Color<Real> color = color_at(world_.paints[object], world_.bodies, at->object, at->P);
    const Color<Real> local = record_.local(lights(k, color, *at, -ray.dir));

    // The note has no depth limit. At ours R and T are zero.
    if (depth <= 0)
        return local;

    // Total internal reflection: nothing is transmitted, and kt's share joins the mirror's.
    const auto refracted = any_positive(k.kt) ? glass_.refraction_ray(ray, *at) : std::nullopt;
    const Color<Real> mirrored = refracted ? k.ks : k.ks + k.kt;

    Color<Real> sum = local;
    if (any_positive(mirrored)) {
        record_.mirrored(mirrored);
        const Color<Real> R = child(reflection_ray(ray, *at), depth - 1, weight.of_child(mirrored));
        sum += mirrored * R;
    }
    if (refracted) {
        record_.refracted(k.kt);
        const Color<Real> T = child(*refracted, depth - 1, weight.of_child(k.kt));
        sum += k.kt * T;
    }
    return sum;
}

// A ray below Scene::min_weight brings no light.
template <class Real, class Recorder>
Color<Real> Note002<Real, Recorder>::child(const Ray<Real>& ray, int depth,
                                           const RayWeight<Real>& weight) const
{
    return is_cut(world_, weight, world_.max_depth - depth) ? Color<Real>()
                                                            : intensity(ray, depth, weight);
}

// Ia + kd sum(N.Lj) + ks sum((Rj.V)^ns), each light by its intensity and the share of it that
// the occluders pass on.
template <class Real, class Recorder>
Color<Real> Note002<Real, Recorder>::lights(const Constants& k, const Color<Real>& color,
                                            const SurfacePoint<Real>& at, const Vec3<Real>& V) const
{
    Color<Real> sum = k.Ia * color * world_.ambient;
    for (const LightSource<Real>& light : world_.lights) {
        if (light.type == LightType::ambient)
            continue;
        const WayToLight<Real> way = way_to_light(light, at.P);
        const Color<Real> seen = record_.share(light.number, light_share(world_, glass_, at, way));
        if (!any_positive(seen))
            continue;
        const Vec3<Real> Lj = way.L;
        // A light behind the surface adds nothing.
        const Real n_dot_l = dot(at.N, Lj);
        if (!(n_dot_l > 0))
            continue;
        const Vec3<Real> Rj = reflect_ray(Lj, at.N);
        const Real r_dot_v = dot(Rj, V);
        const Real highlight = r_dot_v > 0 ? std::pow(r_dot_v, k.ns) : Real(0);
        sum += record_.adds(seen * light.intensity * (k.kd * color * n_dot_l + k.ks * highlight));
    }
    return sum;
}

template <class Real, class Recorder>
Color<Real> Note002<Real, Recorder>::trace_ray(const Vec3<Real>& org, const Vec3<Real>& dir,
                                               const RayWeight<Real>& weight) const
{
    return intensity({org, normalize(dir), around_eye_}, world_.max_depth, weight);
}

template class Note002<float>;
template class Note002<double>;
template class Note002<long double>;
template class Note002<float, TreeRecorder>;
template class Note002<double, TreeRecorder>;

}  // namespace packtrace::reference
