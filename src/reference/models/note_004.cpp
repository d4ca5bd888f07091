#include "reference/models/note_004.hpp"

#include "reference/shadow.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace packtrace::reference {
namespace {

// The note's object.intersection: the least t in [t_min, t_max], or -1.0 for none.
template <class Real>
std::pair<Real, Part> intersection(const PlacedBody<Real>& object, const Vec3<Real>& e,
                                   const Vec3<Real>& d, Real t_min, Real t_max)
{
    std::pair<Real, Part> least{-1, Part::side};
    const auto roots =
        std::visit([&](const auto& surface) { return roots_of(surface, e, d); }, object.surface);
    for (const auto& root : roots)
        if (root.t >= t_min && root.t <= t_max && (least.first == -1 || root.t < least.first))
            least = {root.t, root.part};
    return least;
}

// The note's object.normalVector, made unit; it is not turned to the viewer, who looks along Td.
template <class Real>
Vec3<Real> normal_vector(const PlacedBody<Real>& object, const Vec3<Real>& I, Part part,
                         const Vec3<Real>& Td)
{
    const Vec3<Real> normal = std::visit(
        [&](const auto& surface) { return normal_at(surface, I, part); }, object.surface);
    return unit(normal).value_or(-normalize(Td));
}

// Direction and distance from `I` to the light in the object's own space.
template <class Real>
std::pair<Vec3<Real>, Real> to_light(const PlacedBody<Real>& object, const Vec3<Real>& I,
                                     const LightSource<Real>& light)
{
    if (light.type == LightType::directional)
        return {normalize(object.placement.vector_to_own(light.vector)), infinity<Real>};
    const Vec3<Real> Ts = object.placement.point_to_own(light.vector);
    const Real distance = length(Ts - I);
    return {(Ts - I) / distance, distance};
}

}  // namespace

template <class Real, class Recorder>
Note004<Real, Recorder>::Note004(const Scene& scene, const World<Real>& world, Recorder record)
    : record_(record), world_(world)
{
    for (const Object& object : scene.objects) {
        object_list_.push_back(
            place_body<Real>(object, static_cast<int>(object_list_.size()), world.self_hits));
        if (object.casts_shadow)
            occluders_.push_back(object_list_.back());
        Material material;
        for (std::size_t i = 0; i < 4; ++i)
            material.r[i] = static_cast<Real>(model_of<ShaderMaterial>(object).reflectance[i]);
        materials_.push_back(material);
    }
}

template <class Real, class Recorder>
void Note004<Real, Recorder>::minimum_intersection(const Vec3<Real>& e, const Vec3<Real>& d,
                                                   std::vector<Tuple>& list) const
{
    list.clear();
    for (int k = 0; k < static_cast<int>(object_list_.size()); ++k) {
        const PlacedBody<Real>& object = object_list_[static_cast<std::size_t>(k)];
        const Vec3<Real> Te = object.placement.point_to_own(e);
        const Vec3<Real> Td = object.placement.vector_to_own(d);
        const auto [t0, part] = intersection(object, Te, Td, epsilon<Real>, infinity<Real>);
        if (t0 != -1)
            list.push_back({k, t0, part});
    }
    std::sort(list.begin(), list.end(), [](const Tuple& a, const Tuple& b) {
        return std::pair(a.t0, a.k) < std::pair(b.t0, b.k);
    });
}

template <class Real, class Recorder>
Color<Real> Note004<Real, Recorder>::shader(const Tuple& intersection, const Vec3<Real>& d,
                                            const Vec3<Real>& e,
                                            const LightSource<Real>& light) const
{
    const auto& [k, t0, part] = intersection;
    const PlacedBody<Real>& object = object_list_[static_cast<std::size_t>(k)];
    const Vec3<Real> Te = object.placement.point_to_own(e);
    const Vec3<Real> Td = object.placement.vector_to_own(d);
    const Vec3<Real> I = Te + Td * t0;
    const Real* r = materials_[static_cast<std::size_t>(k)].r;
    const Paint<Real>& paint = world_.paints[static_cast<std::size_t>(k)];
    const Color<Real> c = paint.checkered ? checker_color(paint, I) : paint.color;
    const Color<Real> Li = light.intensity;
    // Not in the note: an ambient light has no position, and gives as much as an occluded light.
    if (light.type == LightType::ambient)
        return r[0] * (c * Li);
    const auto [S, distance] = to_light(object, I, light);
    const Vec3<Real> N = normal_vector(object, I, part, Td);
    const Vec3<Real> R = -S + (2 * dot(S, N)) * N;
    const Vec3<Real> V = normalize(Te - I);
    const Real Id = std::max(dot(N, S), Real(0));
    const Real Is = std::max(dot(R, V), Real(0));
    Real f = r[0];
    const Departure<Real> on{k, part, unit(object.placement.normal_to_world(N)).value_or(N)};
    bool occluded = false;
    if (light.casts_shadow && world_.self_hits == SelfHits::exact) {
        const Vec3<Real> P =
            on_surface(world_.bodies, {t0, k, part}, object.placement.point_to_world(I),
                       length(e) + t0 * length(d));
        occluded = shadowed_exactly(on, P, object.placement.vector_to_world(S), light, distance);
    } else if (light.casts_shadow) {
        occluded = shadowed(object, I, S, distance);
    }
    if (!record_.occluded(light.number, occluded))
        f = r[0] + r[1] * Id + r[2] * (Is > 0 ? std::pow(Is, r[3]) : Real(0));
    // r0 is ambient light, which is never occluded.
    (void)record_.adds((f - r[0]) * (c * Li));
    return f * (c * Li);
}

template <class Real, class Recorder>
bool Note004<Real, Recorder>::shadowed(const PlacedBody<Real>& shaded, const Vec3<Real>& own_I,
                                       const Vec3<Real>& own_S, Real distance) const
{
    if (world_.shadows == ShadowKind::none)
        return false;
    const Vec3<Real> I = shaded.placement.point_to_world(own_I + epsilon<Real> * own_S);
    const Vec3<Real> S = shaded.placement.vector_to_world(own_S);
    for (const PlacedBody<Real>& object : occluders_) {
        // The note assigns the results to I and S themselves, so that each object would start from
        // the space of the one before. Here each starts from world space.
        const Vec3<Real> Te = object.placement.point_to_own(I);
        // S is not made unit here: then t counts the same in every space, and the ray can end at
        // the light, as "the ray from the intersection point to the light source" does.
        const Vec3<Real> Td = object.placement.vector_to_own(S);
        if (intersection(object, Te, Td, Real(0), distance - epsilon<Real>).first != -1)
            return true;
    }
    return false;
}

template <class Real, class Recorder>
bool Note004<Real, Recorder>::shadowed_exactly(const Departure<Real>& on, const Vec3<Real>& P,
                                               const Vec3<Real>& S, const LightSource<Real>& light,
                                               Real distance) const
{
    if (world_.shadows == ShadowKind::none)
        return false;
    const Start<Real> start = start_at(world_, on.along(S), P);
    const auto place = place_of_light(world_, light);
    return std::any_of(occluders_.begin(), occluders_.end(), [&](const auto& object) {
        return occludes(object, start, S, distance, place);
    });
}

// The note has one light source; here the colours of all lights are summed.
template <class Real, class Recorder>
Color<Real> Note004<Real, Recorder>::trace_ray(const Vec3<Real>& e, const Vec3<Real>& d,
                                               const RayWeight<Real>&) const
{
    thread_local std::vector<Tuple> list;  // kept, so that no ray allocates
    const Vec3<Real> direction = normalize(d);
    const auto traced = record_.ray(e, direction);
    minimum_intersection(e, direction, list);
    if (list.empty())
        return record_.miss(world_.background);
    const Tuple& first = list.front();
    record_.outward_hit(world_.bodies, Hit<Real>{first.t0, first.k, first.part},
                        e + direction * first.t0, direction);
    Color<Real> color;
    for (const LightSource<Real>& light : world_.lights)
        color += shader(first, direction, e, light);
    return record_.local(color);
}

template class Note004<float>;
template class Note004<double>;
template class Note004<long double>;
template class Note004<float, TreeRecorder>;
template class Note004<double, TreeRecorder>;

}  // namespace packtrace::reference
