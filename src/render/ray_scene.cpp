#include "bounds/bounded_scene.hpp"
#include "render/check_arrays.hpp"
#include "render/check_options.hpp"
#include "render/moved_objects.hpp"
#include "render/ray_backend.hpp"
#include "render/ray_pieces.hpp"
#include "scene/scene_faults.hpp"
#include <packtrace/intersect.hpp>
#include <packtrace/validate.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace packtrace {

void detail::check_length(const char* name, std::size_t length, std::size_t wanted)
{
    if (length != wanted)
        throw std::invalid_argument(std::string(name) + " has " + std::to_string(length) +
                                    " elements, where there are " + std::to_string(wanted) +
                                    " rays; give it one for each ray");
}

namespace {

template <class Real>
void check_take(const typename RayScene<Real>::TakeHits& take)
{
    if (!take)
        throw std::invalid_argument("`take` is empty; give a function for the hits of a ray");
}

}  // namespace

template <class Real>
struct RayScene<Real>::State {
    explicit State(const Scene& scene) : bounded(scene)
    {
        for (const Light& light : scene.lights)
            lights.push_back(light.type);
    }

    /// The index of a light among those that are not ambient, and so can be occluded. Throws
    /// std::invalid_argument for other indices.
    [[nodiscard]] std::size_t place_of_light(std::size_t light) const;

    /// `moved` has objects of the scene, without duplicates.
    SceneUpdate update(const Scene& scene, const std::vector<std::int32_t>& moved);

    bounds::BoundedScene bounded;
    std::vector<LightType> lights;
    std::vector<MovedShape> shapes;  ///< of the last update, kept to reuse its memory
    std::unique_ptr<RayBackend<Real>> backend;
};

template <class Real>
RayScene<Real>::RayScene(const Scene& scene, const RenderOptions& options)
    : state_(std::make_unique<State>(scene))
{
    check_kernel(options);
    if (options.kernel == Kernel::scalar) {
        validate(scene);
        state_->backend = scalar_backend<Real>(scene);
    } else {
        state_->backend = packet_backend<Real>(scene, options);
    }
}

template <class Real>
RayScene<Real>::~RayScene() = default;
template <class Real>
RayScene<Real>::RayScene(RayScene&&) noexcept = default;
template <class Real>
RayScene<Real>& RayScene<Real>::operator=(RayScene&&) noexcept = default;

template <class Real>
SceneUpdate RayScene<Real>::State::update(const Scene& scene,
                                          const std::vector<std::int32_t>& moved)
{
    if (moved.empty())
        return {};
    if (auto fault = language::fault_of_shapes(scene, moved, shapes))
        throw language::SceneFaultError(*std::move(fault));
    const SceneUpdate done = backend->update(scene, shapes);
    bounded.replace(scene, shapes);
    return done;
}

template <class Real>
std::size_t RayScene<Real>::State::place_of_light(std::size_t light) const
{
    if (light >= lights.size())
        throw std::invalid_argument("lights[" + std::to_string(light) + "] of " +
                                    std::to_string(lights.size()) + "; they count from 0");
    if (lights[light] == LightType::ambient)
        throw std::invalid_argument("lights[" + std::to_string(light) +
                                    "] is ambient, which nothing is in the way of; give a point or "
                                    "directional light");
    const auto end = lights.begin() + static_cast<std::ptrdiff_t>(light);
    return light - static_cast<std::size_t>(std::count(lights.begin(), end, LightType::ambient));
}

template <class Real>
SceneUpdate RayScene<Real>::update(const Scene& scene, std::span<const std::int32_t> moved)
{
    check_same_objects(scene.objects.size(), state_->bounded.object_count());
    return state_->update(scene, distinct_objects(moved, scene.objects.size()));
}

template <class Real>
SceneUpdate RayScene<Real>::update(const Scene& scene)
{
    check_same_objects(scene.objects.size(), state_->bounded.object_count());
    return state_->update(scene, moved_objects(state_->bounded, scene));
}

template <class Real>
void RayScene<Real>::closest_hits(const RaysView<Real>& rays, const HitsView<Real>& hits,
                                  const QueryWatch& watch) const
{
    check_rays(rays);
    check_hits(hits, rays.count);
    for_watched_pieces(rays.count, watch, [&](std::size_t first, std::size_t count) {
        state_->backend->closest_hits(part_of(rays, first, count), nullptr, part_of(hits, first));
    });
}

template <class Real>
void RayScene<Real>::closest_hits(const RaysView<Real>& rays, const StartsView<Real>& starts,
                                  const HitsView<Real>& hits, const QueryWatch& watch) const
{
    check_rays(rays);
    check_starts(starts, rays.count);
    check_hits(hits, rays.count);
    for_watched_pieces(rays.count, watch, [&](std::size_t first, std::size_t count) {
        const StartsView<Real> part = part_of(starts, first);
        state_->backend->closest_hits(part_of(rays, first, count), &part, part_of(hits, first));
    });
}

template <class Real>
void RayScene<Real>::occluded(const RaysView<Real>& rays, std::uint8_t* mask,
                              const QueryWatch& watch) const
{
    check_rays(rays);
    check_array(mask, "mask", rays.count);
    for_watched_pieces(rays.count, watch, [&](std::size_t first, std::size_t count) {
        state_->backend->occluded(part_of(rays, first, count), mask + first);
    });
}

template <class Real>
void RayScene<Real>::lit(const PointsView<Real>& points, std::size_t light, std::uint8_t* mask,
                         const QueryWatch& watch) const
{
    const std::size_t place = state_->place_of_light(light);
    check_vector(points.point, "point", points.count);
    check_array(mask, "mask", points.count);
    for_watched_pieces(points.count, watch, [&](std::size_t first, std::size_t count) {
        state_->backend->lit(part_of(points, first, count), place, mask + first);
    });
}

template <class Real>
void RayScene<Real>::all_hits(const RaysView<Real>& rays, const TakeHits& take,
                              const QueryWatch& watch) const
{
    check_rays(rays);
    check_take<Real>(take);
    for_watched_pieces(rays.count, watch, [&](std::size_t first, std::size_t count) {
        if (first == 0)
            return state_->backend->all_hits(part_of(rays, first, count), take);
        state_->backend->all_hits(part_of(rays, first, count),
                                  [&](std::size_t ray, std::span<const SurfaceHit<Real>> hits) {
                                      take(first + ray, hits);
                                  });
    });
}

namespace {

template <class Real>
bounds::Line line_of(const RaysView<Real>& rays, std::size_t i)
{
    return {Vec3(rays.org_x[i], rays.org_y[i], rays.org_z[i]),
            Vec3(rays.dir_x[i], rays.dir_y[i], rays.dir_z[i])};
}

template <class Real>
bounds::Range range_of(const RaysView<Real>& rays, std::size_t i)
{
    return {rays.t_min[i], rays.t_max[i]};
}

void check_object(std::int32_t object, std::int32_t least, std::size_t count)
{
    if (object < least || object >= static_cast<std::int64_t>(count))
        throw std::invalid_argument("object " + std::to_string(object) + " of " +
                                    std::to_string(count) +
                                    "; objects count from 0, as in Scene::objects");
}

}  // namespace

template <class Real>
void RayScene<Real>::bound_closest_hits(const RaysView<Real>& rays, const std::int32_t* object,
                                        HitBounds* bounds, const QueryWatch& watch) const
{
    check_rays(rays);
    check_array(object, "object", rays.count);
    check_array(bounds, "bounds", rays.count);
    for_watched_pieces(rays.count, watch, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            check_object(object[i], -1, state_->bounded.object_count());
            bounds[i] = object[i] < 0 ? HitBounds{}
                                      : state_->bounded.first_hit(object[i], line_of(rays, i),
                                                                  range_of(rays, i));
        }
    });
}

template <class Real>
void RayScene<Real>::bound_all_hits(const RaysView<Real>& rays, std::size_t ray,
                                    std::span<const SurfaceHit<Real>> hits,
                                    std::span<HitBounds> bounds) const
{
    check_rays(rays);
    detail::check_length("bounds", bounds.size(), hits.size());
    if (ray >= rays.count)
        throw std::invalid_argument("ray " + std::to_string(ray) + " of " +
                                    std::to_string(rays.count) + "; rays count from 0");
    // Sort the hits by object.
    std::vector<std::size_t> order(hits.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return hits[a].object < hits[b].object; });
    std::vector<double> t;
    std::vector<HitBounds> found;
    for (std::size_t first = 0; first < order.size(); first += t.size()) {
        const std::int32_t object = hits[order[first]].object;
        check_object(object, 0, state_->bounded.object_count());
        t.clear();
        while (first + t.size() < order.size() && hits[order[first + t.size()]].object == object)
            t.push_back(hits[order[first + t.size()]].t);
        found.resize(t.size());
        state_->bounded.all_hits(object, line_of(rays, ray), range_of(rays, ray), t, found);
        for (std::size_t i = 0; i < t.size(); ++i)
            bounds[order[first + i]] = found[i];
    }
}

template <class Real>
void RayScene<Real>::closest_hits(const RayStructs<Real>& rays, const HitStructs<Real>& hits,
                                  const QueryWatch& watch) const
{
    detail::check_length("hits", hits.count, rays.count);
    check_array(hits.first, "hits", hits.count);
    HitChunk<Real> found;
    for_chunks(rays, watch, [&](const RaysView<Real>& chunk, std::size_t first) {
        closest_hits(chunk, found.view());
        found.write(hits, first, chunk.count);
    });
}

template <class Real>
void RayScene<Real>::occluded(const RayStructs<Real>& rays, std::span<std::uint8_t> mask,
                              const QueryWatch& watch) const
{
    detail::check_length("mask", mask.size(), rays.count);
    for_chunks(rays, watch, [&](const RaysView<Real>& chunk, std::size_t first) {
        occluded(chunk, mask.data() + first);
    });
}

template <class Real>
void RayScene<Real>::all_hits(const RayStructs<Real>& rays, const TakeHits& take,
                              const QueryWatch& watch) const
{
    check_take<Real>(take);
    for_chunks(rays, watch, [&](const RaysView<Real>& chunk, std::size_t first) {
        all_hits(chunk, [&](std::size_t ray, std::span<const SurfaceHit<Real>> hits) {
            take(first + ray, hits);
        });
    });
}

template <class Real>
void RayScene<Real>::bound_closest_hits(const RayStructs<Real>& rays,
                                        std::span<const std::int32_t> object,
                                        std::span<HitBounds> bounds, const QueryWatch& watch) const
{
    detail::check_length("object", object.size(), rays.count);
    detail::check_length("bounds", bounds.size(), rays.count);
    for_chunks(rays, watch, [&](const RaysView<Real>& chunk, std::size_t first) {
        bound_closest_hits(chunk, object.data() + first, bounds.data() + first);
    });
}

template <class Real>
SurfaceHit<Real> RayScene<Real>::closest_hit(const Ray<Real>& ray) const
{
    SurfaceHit<Real> hit;
    closest_hits(RayStructs<Real>(&ray, 1), HitStructs<Real>(&hit, 1));
    return hit;
}

template <class Real>
bool RayScene<Real>::occluded(const Ray<Real>& ray) const
{
    std::uint8_t mask = 0;
    occluded(RayStructs<Real>(&ray, 1), std::span(&mask, 1));
    return mask != 0;
}

template <class Real>
std::vector<SurfaceHit<Real>> RayScene<Real>::all_hits(const Ray<Real>& ray) const
{
    std::vector<SurfaceHit<Real>> found;
    all_hits(RayStructs<Real>(&ray, 1), [&](std::size_t, std::span<const SurfaceHit<Real>> hits) {
        found.assign(hits.begin(), hits.end());
    });
    return found;
}

template <class Real>
HitBounds RayScene<Real>::bound_closest_hit(const Ray<Real>& ray, std::int32_t object) const
{
    HitBounds bounds;
    bound_closest_hits(RayStructs<Real>(&ray, 1), std::span(&object, 1), std::span(&bounds, 1));
    return bounds;
}

template <class Real>
std::vector<HitBounds> RayScene<Real>::bound_all_hits(const Ray<Real>& ray,
                                                      std::span<const SurfaceHit<Real>> hits) const
{
    std::vector<HitBounds> bounds(hits.size());
    for_chunks(RayStructs<Real>(&ray, 1), {}, [&](const RaysView<Real>& chunk, std::size_t) {
        bound_all_hits(chunk, 0, hits, bounds);
    });
    return bounds;
}

template class RayScene<float>;
template class RayScene<double>;

}  // namespace packtrace
