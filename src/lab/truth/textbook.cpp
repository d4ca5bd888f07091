#include "lab/truth/textbook.hpp"

#include "reference/vec3.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <limits>
#include <variant>

namespace packtrace::lab {
namespace {

using reference::dot;

/// The coefficients of a surface relative to its position.
struct Definition {
    std::array<double, 10> coefficients;
    Vec3 place;
};

Definition define(const Sphere& sphere)
{
    return {{1, 1, 1, 0, 0, 0, 0, 0, 0, -sphere.radius * sphere.radius}, sphere.center};
}

Definition define(const Plane& plane)
{
    const Vec3& n = plane.normal;
    return {{0, 0, 0, 0, 0, 0, n.x, n.y, n.z, 0}, plane.point};
}

/// The polygon's plane; within_edges() decides whether a point is in the polygon.
Definition define(const Polygon& polygon)
{
    const Vec3 n = polygon_normal(polygon);
    return {{0, 0, 0, 0, 0, 0, n.x, n.y, n.z, 0}, polygon.contours[0][0]};
}

Definition define(const Quadric& quadric)
{
    return {quadric.coefficients, Vec3(0.0)};
}

template <class Real>
using Vec = reference::Vec3<Real>;

template <class Real>
Real second_order(const Real (&k)[10], const Vec<Real>& v)
{
    return k[0] * v.x * v.x + k[1] * v.y * v.y + k[2] * v.z * v.z + k[3] * v.x * v.y +
           k[4] * v.x * v.z + k[5] * v.y * v.z;
}

template <class Real>
Vec<Real> gradient(const Real (&k)[10], const Vec<Real>& p)
{
    return {2 * k[0] * p.x + k[3] * p.y + k[4] * p.z + k[6],
            2 * k[1] * p.y + k[3] * p.x + k[5] * p.z + k[7],
            2 * k[2] * p.z + k[4] * p.x + k[5] * p.y + k[8]};
}

template <class Real>
Real value(const Real (&k)[10], const Vec<Real>& p)
{
    return second_order(k, p) + k[6] * p.x + k[7] * p.y + k[8] * p.z + k[9];
}

/// The four possible hits of a line: two on the side, two on the caps; NaN or infinite for none.
template <class Real>
struct Places {
    Real t[4];
};

template <class Real>
Places<Real> roots(const Real (&k)[10], const Vec<Real>& p, const Vec<Real>& v)
{
    constexpr Real none = std::numeric_limits<Real>::infinity();
    const Real a = second_order(k, v);
    const Real b = dot(gradient(k, p), v);
    const Real c = value(k, p);
    if (a == 0)
        return {{-c / b, none, none, none}};
    const Real discriminant = b * b - 4 * a * c;
    if (discriminant < 0)
        return {{none, none, none, none}};
    const Real root = std::sqrt(discriminant);
    return {{(-b - root) / (2 * a), (-b + root) / (2 * a), none, none}};
}

}  // namespace

template <class Real>
TextbookScene<Real>::TextbookScene(const Scene& scene)
{
    for (const Object& object : scene.objects) {
        TextbookBody<Real> body;
        const auto [coefficients, place] =
            std::visit([](const auto& surface) { return define(surface); }, object.surface);
        const Mat4 inverse = glm::inverse(glm::translate(object.transform, place));
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column)
                body.own[row][column] = static_cast<Real>(inverse[column][row]);
        for (std::size_t i = 0; i < 10; ++i)
            body.coefficient[i] = static_cast<Real>(coefficients[i]);
        if (const auto* quadric = std::get_if<Quadric>(&object.surface)) {
            if (quadric->z_range) {
                body.low = static_cast<Real>(quadric->z_range->low);
                body.high = static_cast<Real>(quadric->z_range->high);
            }
            body.capped = quadric->capped;
        }
        if (const auto* polygon = std::get_if<Polygon>(&object.surface))
            for (const auto& contour : polygon->contours)
                for (std::size_t corner = 0; corner < contour.size(); ++corner)
                    for (const Vec3& end :
                         {contour[corner], contour[(corner + 1) % contour.size()]})
                        body.corners.push_back({static_cast<Real>(end.x - place.x),
                                                static_cast<Real>(end.y - place.y),
                                                static_cast<Real>(end.z - place.z)});
        bodies_.push_back(body);
    }
}

namespace {

template <class Real>
Vec<Real> direction_to_own(const TextbookBody<Real>& body, const Vec<Real>& d)
{
    const auto& m = body.own;
    return {m[0][0] * d.x + m[0][1] * d.y + m[0][2] * d.z,
            m[1][0] * d.x + m[1][1] * d.y + m[1][2] * d.z,
            m[2][0] * d.x + m[2][1] * d.y + m[2][2] * d.z};
}

/// By the even-odd rule, in the projection along the axis nearest to the polygon's normal.
template <class Real>
bool within_edges(const TextbookBody<Real>& body, const Vec<Real>& p)
{
    const Real* const n = body.coefficient + 6;
    std::size_t along = std::abs(n[1]) > std::abs(n[0]) ? 1 : 0;
    along = std::abs(n[2]) > std::abs(n[along]) ? 2 : along;
    const std::size_t x = (along + 1) % 3;
    const std::size_t y = (along + 2) % 3;
    const Real at[3] = {p.x, p.y, p.z};
    bool inside = false;
    for (std::size_t i = 0; i < body.corners.size(); i += 2) {
        const auto& a = body.corners[i];
        const auto& b = body.corners[i + 1];
        if ((a[y] > at[y]) != (b[y] > at[y]))
            inside ^= at[x] < a[x] + (b[x] - a[x]) * (at[y] - a[y]) / (b[y] - a[y]);
    }
    return inside;
}

/// Whether the place number `which` is on the clipped side or on a cap.
template <class Real>
bool on_surface(const TextbookBody<Real>& body, const Vec<Real>& p, int which)
{
    if (!body.corners.empty())
        return within_edges(body, p);
    return which < 2 ? p.z >= body.low && p.z <= body.high : value(body.coefficient, p) <= 0;
}

template <class Real>
Vec3 normal_at(const TextbookBody<Real>& body, const Vec<Real>& p, int which)
{
    const auto& m = body.own;
    const Vec<Real> n = which < 2 ? gradient(body.coefficient, p)
                                  : Vec<Real>(0, 0, which == 2 ? Real(-1) : Real(1));
    const Vec<Real> N =
        reference::normalize(Vec<Real>{m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z,
                                       m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
                                       m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z});
    return {static_cast<double>(N.x), static_cast<double>(N.y), static_cast<double>(N.z)};
}

}  // namespace

template <class Real>
Answer TextbookScene<Real>::closest_hit(const StressRay& ray) const
{
    Answer best{-1, ray.t_max, {}};
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const TextbookBody<Real>& body = bodies_[i];
        const Vec<Real> v = direction_to_own(body, Vec<Real>(ray.dir));
        const Vec<Real> p = direction_to_own(body, Vec<Real>(ray.org)) +
                            Vec<Real>(body.own[0][3], body.own[1][3], body.own[2][3]);
        Places<Real> places = roots(body.coefficient, p, v);
        if (body.capped) {
            places.t[2] = (body.low - p.z) / v.z;
            places.t[3] = (body.high - p.z) / v.z;
        }
        for (int which = 0; which < 4; ++which) {
            const Real t = places.t[which];
            const Vec<Real> at = p + t * v;
            if (t > ray.t_min && t < best.t && on_surface(body, at, which))
                best = {static_cast<std::int32_t>(i), static_cast<double>(t),
                        normal_at(body, at, which)};
        }
    }
    return best;
}

template class TextbookScene<float>;
template class TextbookScene<double>;

}  // namespace packtrace::lab
