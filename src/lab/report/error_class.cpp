#include "lab/report/error_class.hpp"

#include "lab/harness/ray_trees.hpp"
#include "lab/report/neighbour_rays.hpp"
#include "lower/lowered_scene.hpp"
#include "scene/vectors.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace packtrace {
namespace {

struct ClassText {
    const char* name;
    const char* meaning;
};

constexpr std::array<ClassText, error_class_count> texts{{
    {"silhouette", "the camera ray passes an object's edge on its other side"},
    {"shadow edge", "the point seen lies on the other side of a shadow's edge"},
    {"deep", "a mirrored or refracted ray took another way, or was not traced"},
    {"highlight", "the same rays, but another highlight"},
    {"position", "the same rays, but a hit point or normal is off"},
    {"shading", "the same rays, but another colour that is no highlight"},
    {"near start", "a ray met or missed what lies by its start: epsilon"},
    {"lost hit", "a ray missed what lies squarely in its way, or met what does not"},
}};

// A hit is near the start of its ray within this many epsilons.
constexpr double near_epsilons = 100.0;
// Points, normals and shares of light differ if they are further apart than this, relative to their
// size.
constexpr double position_tolerance = 1e-4;
// Hits whose t differ by more than this share are different roots, not one rounded differently.
constexpr double root_tolerance = 1e-2;
// Normals that differ by less than this cannot change diffuse light much.
constexpr double highlight_tolerance = 1e-2;

bool is_other_root(double t, double other)
{
    return std::abs(t - other) > root_tolerance * std::max(t, other);
}

bool apart(const Vec3& a, const Vec3& b)
{
    return glm::distance(a, b) > position_tolerance * std::max(1.0, glm::length(a));
}

}  // namespace

std::string name_of(ErrorClass kind)
{
    return texts[static_cast<std::size_t>(kind)].name;
}

std::string meaning_of(ErrorClass kind)
{
    return texts[static_cast<std::size_t>(kind)].meaning;
}

struct ErrorClassifier::State {
    Scene scene;
    NeighbourRays rays;
    double epsilon;
    double camera_t_min;

    State(const Scene& scene_, const LoweredScene& lowered)
        : scene(scene_), rays(scene_), epsilon(lowered.epsilon), camera_t_min(lowered.camera_t_min)
    {
    }

    // The difference with the largest effect so far.
    struct Finding {
        std::optional<ClassifiedError> worst;

        template <class Classify>
        void offer(double effect, const Classify& classify)
        {
            if (effect > (worst ? worst->effect : 0.0))
                worst = {classify(), effect};
        }
    };

    void compare(const RayNode& truth, const RayNode& tested, int depth, Finding& worst) const
    {
        if (truth.object != tested.object) {
            worst.offer(largest_component(sum_of(truth) - sum_of(tested)),
                        [&] { return of_ray(tested, depth); });
            return;
        }
        if (const auto root = of_root(truth, tested, depth)) {
            worst.offer(largest_component(sum_of(truth) - sum_of(tested)), [&] { return *root; });
            return;
        }
        compare_lights(truth, tested, depth, worst);
        compare_rest(truth, tested, worst);
        for (const RayKind kind : {RayKind::mirrored, RayKind::refracted}) {
            const RayNode* a = child_of(&truth, kind);
            const RayNode* b = child_of(&tested, kind);
            if (a != nullptr && b != nullptr)
                compare(*a, *b, depth + 1, worst);
            else if (a != nullptr || b != nullptr)
                // The whole trees are compared, because a child can change its parent's light.
                worst.offer(largest_component(sum_of(truth) - sum_of(tested)),
                            [] { return ErrorClass::deep; });
        }
    }

    void compare_lights(const RayNode& truth, const RayNode& tested, int depth,
                        Finding& worst) const
    {
        for (const LightShare& light : tested.lights) {
            const LightShare* other = light_of(&truth, light.light);
            if (other == nullptr)
                continue;
            const double effect = largest_component(truth.weight * (other->color - light.color));
            worst.offer(effect, [&] {
                const bool known = light.share && other->share;
                if (known && largest_component(*light.share - *other->share) > position_tolerance)
                    return of_shadow(tested, light, *other, depth);
                return of_color(truth, tested, light.light);
            });
        }
    }

    // Compares what comes from no light: ambient light, the background, the depth limit.
    void compare_rest(const RayNode& truth, const RayNode& tested, Finding& worst) const
    {
        if (truth.object < 0) {
            worst.offer(largest_component(truth.weight * (truth.brought - tested.brought)),
                        [] { return ErrorClass::shading; });
            return;
        }
        if (truth.children.empty() != tested.children.empty())
            return;
        Rgb rest = truth.local + truth.brought - tested.local - tested.brought;
        Rgb lights(0.0);
        for (const LightShare& light : tested.lights)
            if (const LightShare* other = light_of(&truth, light.light))
                lights += other->color - light.color;
        if (largest_component(rest) > largest_component(lights))
            worst.offer(largest_component(truth.weight * (rest - lights)),
                        [&] { return of_geometry(truth, tested); });
    }

    // The class of a tested ray that hit another object than the true ray.
    [[nodiscard]] ErrorClass of_ray(const RayNode& tested, int depth) const
    {
        const auto hit = rays.trace(tested.org, tested.dir, depth == 0 ? camera_t_min : epsilon,
                                    std::numeric_limits<double>::infinity());
        if (!hit.stable || hit.object == tested.object)
            return depth == 0 ? ErrorClass::silhouette : ErrorClass::deep;
        return near_or_lost(hit.t, tested.t, depth);
    }

    // The class of a tested ray that hit the same object at another root; none if it did not.
    [[nodiscard]] std::optional<ErrorClass> of_root(const RayNode& truth, const RayNode& tested,
                                                    int depth) const
    {
        if (truth.object < 0 || !is_other_root(truth.t, tested.t))
            return std::nullopt;
        const auto hit = rays.trace(tested.org, tested.dir, depth == 0 ? camera_t_min : epsilon,
                                    std::numeric_limits<double>::infinity());
        if (!hit.stable || !is_other_root(hit.t, tested.t))
            return std::nullopt;
        return near_or_lost(hit.t, tested.t, depth);
    }

    [[nodiscard]] ErrorClass near_or_lost(double t, double tested_t, int depth) const
    {
        const bool near = std::min(t, tested_t) <= near_epsilons * epsilon;
        return depth > 0 && near ? ErrorClass::near_start : ErrorClass::lost_hit;
    }

    // The class of a point to which another share of a light came.
    [[nodiscard]] ErrorClass of_shadow(const RayNode& tested, const LightShare& light,
                                       const LightShare& truth, int depth) const
    {
        const ErrorClass edge = depth == 0 ? ErrorClass::shadow_edge : ErrorClass::deep;
        const Light& source = scene.lights[static_cast<std::size_t>(light.light)];
        const bool point = source.type == LightType::point;
        const Vec3 way = point ? source.vector - tested.point : source.vector;
        const auto occluder =
            rays.trace(tested.point, way, epsilon,
                       point ? 1.0 - epsilon : std::numeric_limits<double>::infinity());
        const bool occluded = occluder.object >= 0;
        const bool tested_darker =
            largest_component(*light.share) < largest_component(*truth.share);
        if (!occluder.stable || occluded == tested_darker)
            return edge;
        // Without another occluder, the lit surface occluded itself.
        if (!occluded)
            return ErrorClass::near_start;
        return occluder.t <= near_epsilons * epsilon ? ErrorClass::near_start
                                                     : ErrorClass::lost_hit;
    }

    // The class of a hit with another colour from the same share of light.
    [[nodiscard]] ErrorClass of_color(const RayNode& truth, const RayNode& tested, int light) const
    {
        const Light& source = scene.lights[static_cast<std::size_t>(light)];
        const Vec3 way = glm::normalize(
            source.type == LightType::point ? source.vector - truth.point : source.vector);
        const Vec3 mirrored = 2.0 * dot(truth.normal, way) * truth.normal - way;
        if (dot(mirrored, -truth.dir) > 0.0 &&
            glm::distance(truth.normal, tested.normal) < highlight_tolerance)
            return ErrorClass::highlight;
        return of_geometry(truth, tested);
    }

    [[nodiscard]] static ErrorClass of_geometry(const RayNode& truth, const RayNode& tested)
    {
        return apart(truth.point, tested.point) || apart(truth.normal, tested.normal)
                   ? ErrorClass::position
                   : ErrorClass::shading;
    }
};

ErrorClassifier::ErrorClassifier(const Scene& scene)
    : state_(std::make_unique<State>(scene, lower(scene)))
{
}

ErrorClassifier::~ErrorClassifier() = default;
ErrorClassifier::ErrorClassifier(ErrorClassifier&&) noexcept = default;
ErrorClassifier& ErrorClassifier::operator=(ErrorClassifier&&) noexcept = default;

std::optional<ClassifiedError> ErrorClassifier::classify(const RayNode& truth,
                                                         const RayNode& tested) const
{
    State::Finding worst;
    state_->compare(truth, tested, 0, worst);
    return worst.worst;
}

}  // namespace packtrace
