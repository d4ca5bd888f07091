#include "reference/models/note_001.hpp"

#include "reference/shadow.hpp"

#include <cmath>

namespace packtrace::reference {

template <class Real, class Recorder>
Note001<Real, Recorder>::Note001(const Scene& scene, const World<Real>& world, Recorder record)
    : record_(record), world_(world)
{
    for (const Object& object : scene.objects) {
        const auto& material = model_of<ScratchMaterial>(object);
        shadings_.push_back(
            {static_cast<Real>(material.specular), static_cast<Real>(material.reflective)});
        is_a_sphere_.push_back(std::holds_alternative<Sphere>(object.surface));
    }
}

template <class Real, class Recorder>
Color<Real> Note001<Real, Recorder>::compute_lighting(const Vec3<Real>& P, const Vec3<Real>& N,
                                                      const Vec3<Real>& V, Real s,
                                                      const Departure<Real>& on) const
{
    Color<Real> i(0, 0, 0);
    for (const LightSource<Real>& light : world_.lights) {
        if (light.type == LightType::ambient) {
            i += light.intensity;
            continue;
        }
        const bool is_point = light.type == LightType::point;
        const Vec3<Real> L = is_point ? light.vector - P : light.vector;
        const Real t_max = is_point ? Real(1) : infinity<Real>;

        // The listing kept only the `continue` of its shadow check.
        if (record_.occluded(light.number, light.casts_shadow && in_shadow(on, P, L, light, t_max)))
            continue;

        // Diffuse
        const Real n_dot_l = dot(N, L);
        if (n_dot_l > 0)
            i += record_.adds(light.intensity * (n_dot_l / (length(N) * length(L))));

        // Specular; the note lights it also where the light is behind the surface.
        if (s != -1) {
            const Vec3<Real> R = reflect_ray(L, N);
            const Real r_dot_v = dot(R, V);
            if (r_dot_v > 0)
                i += record_.adds(light.intensity * std::pow(r_dot_v / (length(R) * length(V)), s));
        }
    }
    return i;
}

template <class Real, class Recorder>
bool Note001<Real, Recorder>::in_shadow(const Departure<Real>& on, const Vec3<Real>& P,
                                        const Vec3<Real>& L, const LightSource<Real>& light,
                                        Real t_max) const
{
    if (world_.shadows == ShadowKind::none)
        return false;
    const Start<Real> start = start_at(world_, on.along(L), P);
    // The note finds the closest sphere, where any occluder suffices.
    return any_in_way(world_.occluders, start, L, t_max, place_of_light(world_, light));
}

// The note has only spheres and lets N point away from the centre even when seen from inside.
// Planes and quadrics have no such side: theirs faces the viewer.
template <class Real, class Recorder>
const Vec3<Real>& Note001<Real, Recorder>::normal(const SurfacePoint<Real>& at) const
{
    return is_a_sphere_[static_cast<std::size_t>(at.object)] ? at.outward : at.N;
}

template <class Real, class Recorder>
Color<Real> Note001<Real, Recorder>::trace_ray(const Vec3<Real>& O, const Vec3<Real>& D, Real t_min,
                                               Real t_max, int depth,
                                               const RayWeight<Real>& weight) const
{
    return trace_ray(Start<Real>{O, O, t_min}, D, t_max, depth, weight);
}

template <class Real, class Recorder>
Color<Real> Note001<Real, Recorder>::trace_ray(const Start<Real>& start, const Vec3<Real>& D,
                                               Real t_max, int depth,
                                               const RayWeight<Real>& weight) const
{
    const auto traced = record_.ray(start.on, D);
    const auto closest = closest_surface(world_, start, D, t_max);
    if (!closest)
        return record_.miss(world_.background);

    // Compute local color
    const auto object = static_cast<std::size_t>(closest->object);
    const Vec3<Real>& P = closest->P;
    const Vec3<Real>& N = normal(*closest);
    record_.hit(closest->t, closest->object, P, N);
    const Color<Real> color = color_at(world_.paints[object], world_.bodies, closest->object, P);
    const Color<Real> local_color =
        color * compute_lighting(P, N, -D, shadings_[object].specular, closest->back());
    record_.tint(color);

    // If we hit the recursion limit or the object is not reflective, we're done
    const Real r = shadings_[object].reflective;
    if (depth <= 0 || r <= 0)
        return record_.local(local_color);

    // Compute the reflected color, none below Scene::min_weight
    const RayWeight<Real> reflected = weight.of_child(Color<Real>(r, r, r));
    if (is_cut(world_, reflected, world_.max_depth - depth + 1))
        return record_.local(local_color * (1 - r));
    const Vec3<Real> R = reflect_ray(-D, N);
    record_.mirrored(Color<Real>(r, r, r));
    const Color<Real> reflected_color =
        trace_ray(start_at(world_, closest->back(), P), R, infinity<Real>, depth - 1, reflected);

    return record_.local(local_color * (1 - r)) + reflected_color * r;
}

template <class Real, class Recorder>
Color<Real> Note001<Real, Recorder>::trace_ray(const Vec3<Real>& O, const Vec3<Real>& D,
                                               const RayWeight<Real>& weight) const
{
    return trace_ray(O, D, 1, infinity<Real>, world_.max_depth, weight);
}

template class Note001<float>;
template class Note001<double>;
template class Note001<long double>;
template class Note001<float, TreeRecorder>;
template class Note001<double, TreeRecorder>;

}  // namespace packtrace::reference
