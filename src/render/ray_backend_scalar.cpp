#include "reference/shadow.hpp"
#include "reference/surfaces/bodies.hpp"
#include "reference/surfaces/hits.hpp"
#include "render/ray_backend.hpp"
#include "scene/casting_objects.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace packtrace {
namespace {

template <class Real>
struct ScalarRay {
    reference::Vec3<Real> org;
    reference::Vec3<Real> dir;
    Real t_min;
    Real t_max;

    ScalarRay(const RaysView<Real>& rays, std::size_t i)
        : org{rays.org_x[i], rays.org_y[i], rays.org_z[i]},
          dir{rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]},
          t_min(rays.t_min[i]),
          t_max(rays.t_max[i])
    {
    }
};

template <class Real>
class ScalarBackend final : public RayBackend<Real> {
public:
    explicit ScalarBackend(const Scene& scene)
        : casts_shadow_(casting_objects(scene)), bodies_(scene), casters_(casters_of(scene))
    {
        for (const Light& light : scene.lights)
            if (light.type != LightType::ambient)
                lights_.push_back(light);
        shadows_ = scene.shadows != ShadowKind::none;
    }

    void closest_hits(const RaysView<Real>& rays, const StartsView<Real>*,
                      const HitsView<Real>& hits) const override
    {
        for (std::size_t i = 0; i < rays.count; ++i) {
            const ScalarRay<Real> ray(rays, i);
            const auto hit = closest(ray);
            hits.t[i] = hit ? hit.t : ray.t_max;
            hits.object[i] = hit.object;
            if (hits.normal_x == nullptr || !hit)
                continue;
            const auto normal =
                reference::facing(bodies_, hit, ray.org + hit.t * ray.dir, ray.dir).outward;
            hits.normal_x[i] = normal.x;
            hits.normal_y[i] = normal.y;
            hits.normal_z[i] = normal.z;
        }
    }

    void occluded(const RaysView<Real>& rays, std::uint8_t* mask) const override
    {
        for (std::size_t i = 0; i < rays.count; ++i)
            mask[i] = closest(ScalarRay<Real>(rays, i)) ? 1 : 0;
    }

    void lit(const PointsView<Real>& points, std::size_t light, std::uint8_t* mask) const override
    {
        const Light& from = lights_[light];
        const reference::Vec3<Real> vector(from.vector);
        const bool is_point = from.type == LightType::point;
        for (std::size_t i = 0; i < points.count; ++i) {
            const reference::Vec3<Real> point{points.point[0][i], points.point[1][i],
                                              points.point[2][i]};
            mask[i] = reaches(from, point, is_point ? vector - point : vector) ? 1 : 0;
        }
    }

    void all_hits(const RaysView<Real>& rays,
                  const typename RayScene<Real>::TakeHits& take) const override
    {
        std::vector<SurfaceHit<Real>> found;
        for (std::size_t i = 0; i < rays.count; ++i) {
            const ScalarRay<Real> ray(rays, i);
            found.clear();
            for (const auto& hit :
                 reference::all_hits(bodies_, ray.org, ray.dir, ray.t_min, ray.t_max))
                if (hit.t > ray.t_min && hit.t < ray.t_max)
                    found.push_back(
                        {hit.t, hit.object, {hit.normal.x, hit.normal.y, hit.normal.z}});
            take(i, found);
        }
    }

    SceneUpdate update(const Scene& scene, std::span<const MovedShape>) override
    {
        bodies_ = reference::Bodies<Real>(scene);
        casters_ = casters_of(scene);
        return {.rebuilt = true};
    }

private:
    // Ray intervals of the reference are closed, those of RaysView are open.
    [[nodiscard]] reference::Hit<Real> closest(const ScalarRay<Real>& ray) const
    {
        const Real inf = std::numeric_limits<Real>::infinity();
        return reference::closest_intersection(bodies_, ray.org, ray.dir,
                                               std::nextafter(ray.t_min, inf),
                                               std::nextafter(ray.t_max, -inf));
    }

    /// The objects that cast shadows; not set if all do.
    [[nodiscard]] std::optional<reference::Bodies<Real>> casters_of(const Scene& scene) const
    {
        if (casts_shadow_.empty())
            return std::nullopt;
        return reference::Bodies<Real>(scene, default_self_hits, [&](const Object& object) {
            return casts_shadow_[static_cast<std::size_t>(&object - scene.objects.data())];
        });
    }

    [[nodiscard]] bool reaches(const Light& light, const reference::Vec3<Real>& point,
                               const reference::Vec3<Real>& way) const
    {
        if (std::isnan(point.x) || std::isnan(point.y) || std::isnan(point.z))
            return false;
        if (!shadows_ || !light.casts_shadow)
            return true;
        const bool is_point = light.type == LightType::point;
        const Real end =
            is_point ? std::nextafter(Real(1), Real(0)) : std::numeric_limits<Real>::max();
        std::optional<reference::Vec3<Real>> place;
        if (is_point)
            place = reference::Vec3<Real>(light.vector);
        const reference::Start<Real> start{point, point, std::numeric_limits<Real>::min()};
        return !any_in_way(casters_ ? *casters_ : bodies_, start, way, end, place);
    }

    std::vector<bool> casts_shadow_;  ///< from casting_objects()
    reference::Bodies<Real> bodies_;
    std::optional<reference::Bodies<Real>> casters_;
    std::vector<Light> lights_;
    bool shadows_ = true;
};

}  // namespace

template <class Real>
std::unique_ptr<RayBackend<Real>> scalar_backend(const Scene& scene)
{
    return std::make_unique<ScalarBackend<Real>>(scene);
}

template std::unique_ptr<RayBackend<float>> scalar_backend(const Scene&);
template std::unique_ptr<RayBackend<double>> scalar_backend(const Scene&);

}  // namespace packtrace
