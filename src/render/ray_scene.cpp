#include <packtrace/intersect.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

#include <packtrace/validate.hpp>

#include "bounds/bounded_scene.hpp"
#include "render/ray_backend.hpp"

namespace packtrace {

template <class Real>
struct RayScene<Real>::State {
    explicit State(const Scene& scene) : bounded(scene)
    {
    }

    bounds::BoundedScene bounded;
    std::unique_ptr<RayBackend<Real>> backend;
};

template <class Real>
RayScene<Real>::RayScene(const Scene& scene, const RenderOptions& options)
    : state_(std::make_unique<State>(scene))
{
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
void RayScene<Real>::closest_hits(const RaysView<Real>& rays, const HitsView<Real>& hits) const
{
    state_->backend->closest_hits(rays, nullptr, hits);
}

template <class Real>
void RayScene<Real>::closest_hits(const RaysView<Real>& rays, const StartsView<Real>& starts,
                                  const HitsView<Real>& hits) const
{
    state_->backend->closest_hits(rays, &starts, hits);
}

template <class Real>
void RayScene<Real>::occluded(const RaysView<Real>& rays, std::uint8_t* mask) const
{
    state_->backend->occluded(rays, mask);
}

template <class Real>
void RayScene<Real>::all_hits(const RaysView<Real>& rays, const TakeHits& take) const
{
    state_->backend->all_hits(rays, take);
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

}  // namespace

template <class Real>
void RayScene<Real>::bound_closest_hits(const RaysView<Real>& rays, const std::int32_t* object,
                                        HitBounds* bounds) const
{
    for (std::size_t i = 0; i < rays.count; ++i)
        bounds[i] = object[i] < 0
                        ? HitBounds{}
                        : state_->bounded.first_hit(object[i], line_of(rays, i), range_of(rays, i));
}

template <class Real>
void RayScene<Real>::bound_all_hits(const RaysView<Real>& rays, std::size_t ray,
                                    std::span<const SurfaceHit<Real>> hits,
                                    std::span<HitBounds> bounds) const
{
    // All hits of one object after the other.
    std::vector<std::size_t> order(hits.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return hits[a].object < hits[b].object; });
    std::vector<double> t;
    std::vector<HitBounds> found;
    for (std::size_t first = 0; first < order.size(); first += t.size()) {
        const std::int32_t object = hits[order[first]].object;
        t.clear();
        while (first + t.size() < order.size() && hits[order[first + t.size()]].object == object)
            t.push_back(hits[order[first + t.size()]].t);
        found.resize(t.size());
        state_->bounded.all_hits(object, line_of(rays, ray), range_of(rays, ray), t, found);
        for (std::size_t i = 0; i < t.size(); ++i)
            bounds[order[first + i]] = found[i];
    }
}

template class RayScene<float>;
template class RayScene<double>;

}  // namespace packtrace
