#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

// Ray tests in long double. They also give what a comparison with lower precision needs: how
// sensitive t is to errors of the inputs, and how far the ray is from just touching the surface.
namespace packtrace::test {

using LongVec = glm::vec<3, long double>;

struct LongRay {
    LongVec org{0.0L};
    LongVec dir{0.0L};
    long double t_min = 0.0L;
};

/// A root and its sensitivity. `condition` is the relative change of t per relative change of the
/// inputs. `margin` is the relative change of the inputs that turns a hit into a miss or back.
struct ExactHit {
    bool hit = false;
    long double t = 0.0L;
    long double condition = 0.0L;
    long double margin = 0.0L;
};

[[nodiscard]] inline LongVec magnitudes(const LongVec& v)
{
    return glm::abs(v);
}

/// The condition of t for a hit of a surface through `place` with gradient `normal`: the sum of the
/// magnitudes of the terms of n·(o + t d - place), over n·d t.
[[nodiscard]] inline long double condition_of(const LongRay& ray, long double t,
                                              const LongVec& normal, const LongVec& place)
{
    const LongVec terms = magnitudes(ray.org) + magnitudes(t * ray.dir) + magnitudes(place);
    return glm::dot(magnitudes(normal), terms) / std::abs(glm::dot(normal, ray.dir) * t);
}

/// The first of two roots, t0 <= t1, beyond the ray's t_min.
[[nodiscard]] inline ExactHit first_beyond(const LongRay& ray, long double t0, long double t1)
{
    return {.hit = t1 > ray.t_min, .t = t0 > ray.t_min ? t0 : t1};
}

/// The distance from t_min to the root, relative to t, in units of its condition.
[[nodiscard]] inline long double start_margin(const LongRay& ray, long double t,
                                              const LongVec& normal, const LongVec& place)
{
    return std::abs(t - ray.t_min) / (std::abs(t) * condition_of(ray, t, normal, place));
}

/// The sphere |P - center|² = radius2. The scene gives the sphere's location by `place`: its
/// centre, or a point of its surface. Relative changes of the inputs move ray and sphere by |org| +
/// |place|.
[[nodiscard]] inline ExactHit exact_sphere(const LongRay& ray, const LongVec& center,
                                           long double radius2, const LongVec& place)
{
    const LongVec o = ray.org - center;
    const LongVec moment = glm::cross(o, ray.dir);
    const long double a = glm::dot(ray.dir, ray.dir);
    const long double b = glm::dot(o, ray.dir);
    const long double c =
        (glm::length(o) - std::sqrt(radius2)) * (glm::length(o) + std::sqrt(radius2));
    const long double discriminant = a * radius2 - glm::dot(moment, moment);
    const long double scale = glm::length(ray.org) + glm::length(place);
    const long double sensitivity =
        2 * glm::length(moment) * std::sqrt(a) * scale + a * std::min(radius2, scale * scale);

    const long double touching = std::abs(discriminant) / sensitivity;
    if (discriminant < 0)
        return {false, 0.0L, 0.0L, touching};

    const long double q = -(b + std::copysign(std::sqrt(discriminant), b));
    const long double t0 = std::min(q / a, c / q);
    const long double t1 = std::max(q / a, c / q);
    ExactHit result = first_beyond(ray, t0, t1);
    result.condition = condition_of(ray, result.t, o + result.t * ray.dir, place);
    result.margin = touching;
    for (const long double t : {t0, t1})
        if (t > 0)
            result.margin = std::min(result.margin, start_margin(ray, t, o + t * ray.dir, place));
    return result;
}

[[nodiscard]] inline ExactHit exact_plane(const LongRay& ray, const LongVec& point,
                                          const LongVec& normal)
{
    const long double t = glm::dot(normal, point - ray.org) / glm::dot(normal, ray.dir);
    ExactHit result = first_beyond(ray, t, t);
    const long double slope =
        std::abs(glm::dot(normal, ray.dir)) / glm::dot(magnitudes(normal), magnitudes(ray.dir));
    const long double height =
        std::abs(glm::dot(normal, point - ray.org)) /
        glm::dot(magnitudes(normal), magnitudes(point) + magnitudes(ray.org));
    result.margin = std::min({slope, height, start_margin(ray, t, normal, point)});
    result.condition = condition_of(ray, t, normal, point);
    return result;
}

}  // namespace packtrace::test
