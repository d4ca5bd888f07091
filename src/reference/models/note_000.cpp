#include "reference/models/note_000.hpp"

#include "reference/shadow.hpp"

#include <algorithm>
#include <cmath>

namespace packtrace::reference {

template <class Real, class Recorder>
Note000<Real, Recorder>::Note000(const Scene& scene, const World<Real>& world, Recorder record)
    : record_(record), world_(world), deepest_(scene.max_depth + 1)
{
    for (const Object& object : scene.objects) {
        const auto& from = model_of<SketchMaterial>(object);
        factors_.push_back({Color<Real>(from.ambient), Color<Real>(from.diffuse),
                            Color<Real>(from.specular), Color<Real>(from.refractive),
                            static_cast<Real>(from.shininess)});
        glass_.bodies.push_back({Color<Real>(from.refractive), static_cast<Real>(from.ior)});
    }
    around_eye_ = glass_.stack_at(world.bodies, world.canvas.position, world.canvas.forward);
}

template <class Real, class Recorder>
Color<Real> Note000<Real, Recorder>::intensity(const Ray<Real>& r, int depth,
                                               const RayWeight<Real>& weight) const
{
    // `depth` is this call's copy, so it need not be decremented again.
    depth = depth + 1;
    if (depth > deepest_)
        return record_.limit(world_.background);
    const auto traced = record_.ray(r.org, r.dir);

    // Take closest intersection, which is object[j], and compute normal N there
    const auto at = closest_surface(world_, r);
    if (!at)
        return record_.miss(escaped(r));
    record_.hit(at->t, at->object, at->P, at->N);
    const auto j = static_cast<std::size_t>(at->object);
    const Factors& k = factors_[j];
    const Ray<Real> flec = reflection_ray(r, *at);

    // At total internal reflection, of which the note says nothing, there is no refracted ray. Its
    // share is added to the mirrored ray, so that Ks + Kr = 1 loses no light.
    const auto frac = any_positive(k.Kr) ? glass_.refraction_ray(r, *at) : std::nullopt;
    const Color<Real> mirrored = frac ? k.Ks : k.Ks + k.Kr;

    Color<Real> spec;
    if (any_positive(mirrored)) {
        record_.mirrored(mirrored);
        spec = mirrored * child(flec, depth, weight.of_child(mirrored));
    }

    Color<Real> refr;
    if (frac) {
        record_.refracted(k.Kr);
        refr = k.Kr * child(*frac, depth, weight.of_child(k.Kr));
    }

    const Color<Real> color = color_at(world_.paints[j], world_.bodies, at->object, at->P);
    return spec + refr + record_.local(dull(k, color, *at, flec));
}

// A ray below Scene::min_weight brings no light. Beyond the depth limit no ray would be traced.
template <class Real, class Recorder>
Color<Real> Note000<Real, Recorder>::child(const Ray<Real>& ray, int depth,
                                           const RayWeight<Real>& weight) const
{
    if (depth < deepest_ && is_cut(world_, weight, depth))
        return {};
    return intensity(ray, depth, weight);
}

// "If r parallel to L": L points from the ray's start to the light source, and parallel means
// that the sine of the angle between them is at most epsilon.
template <class Real, class Recorder>
Color<Real> Note000<Real, Recorder>::escaped(const Ray<Real>& r) const
{
    Color<Real> seen;
    bool parallel = false;
    for (const LightSource<Real>& lsou : world_.lights) {
        if (lsou.type == LightType::ambient)
            continue;
        const Vec3<Real> L = way_to_light(lsou, r.org).L;
        if (dot(r.dir, L) > 0 && length(cross(r.dir, L)) <= epsilon<Real>) {
            seen += lsou.intensity;
            parallel = true;
        }
    }
    return parallel ? seen : world_.background;
}

// The note has one light source; here the lit part is summed over all.
template <class Real, class Recorder>
Color<Real> Note000<Real, Recorder>::dull(const Factors& k, const Color<Real>& color,
                                          const SurfacePoint<Real>& at, const Ray<Real>& flec) const
{
    Color<Real> sum = k.Ka * color * world_.ambient;
    for (const LightSource<Real>& lsou : world_.lights) {
        if (lsou.type == LightType::ambient)
            continue;
        // Check for shadow
        const WayToLight<Real> way = way_to_light(lsou, at.P);
        const Color<Real> lit = record_.share(lsou.number, light_share(world_, glass_, at, way));
        if (!any_positive(lit))
            continue;
        // Not in the note: a negative cosine counts as 0.
        const Real n_dot_l = std::max(dot(at.N, way.L), Real(0));
        const Real flec_dot_l = dot(flec.dir, way.L);
        const Real highlight = flec_dot_l > 0 ? std::pow(flec_dot_l, k.S) : Real(0);
        sum += record_.adds(lit * lsou.intensity * (k.Kd * color * n_dot_l + k.Ks * highlight));
    }
    return sum;
}

template <class Real, class Recorder>
Color<Real> Note000<Real, Recorder>::trace_ray(const Vec3<Real>& org, const Vec3<Real>& dir,
                                               const RayWeight<Real>& weight) const
{
    return intensity({org, normalize(dir), around_eye_}, 0, weight);
}

template class Note000<float>;
template class Note000<double>;
template class Note000<long double>;
template class Note000<float, TreeRecorder>;
template class Note000<double, TreeRecorder>;

}  // namespace packtrace::reference
