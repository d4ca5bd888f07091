#include "geometry/quadric.hpp"

#include "core/quad.hpp"
#include "geometry/canonical_form.hpp"
#include "geometry/kinds.hpp"
#include "scene/elliptic_sections.hpp"
#include "scene/exact_minor.hpp"
#include "scene/language/numbers.hpp"
#include "scene/vectors.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace packtrace {
namespace {

/// Quadrics that stretch space more than this lose so many digits in single precision that no
/// slightly enlarged box contains their hits.
constexpr double worst_condition = 1e3;

struct Bound {
    Vec3 center{0.0};
    double radius = std::numeric_limits<double>::infinity();
    Vec3 half{0.0};  ///< half the sizes of a box
};

/// An upper bound of the length of `m * u` for unit u.
double ellipsoid_radius(const Mat3& m)
{
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

/// An upper bound of the length of `m * u` for u with x² + y² <= 1 and |z| <= 1. The columns need
/// not be orthogonal.
double drum_radius(const Mat3& m)
{
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1])) + glm::length(m[2]);
}

/// The half axes of an ellipsoid in canonical space; not set for other surfaces.
std::optional<Vec3> half_axes(const CanonicalForm& form)
{
    const Vec3 ratio = -form.constant / form.square;
    // The ratio is infinite along the axis of a cylinder.
    if (form.linear != 0.0 || !(ratio.x > 0.0 && ratio.y > 0.0 && ratio.z > 0.0) ||
        !std::isfinite(ratio.x + ratio.y + ratio.z))
        return std::nullopt;
    return glm::sqrt(ratio);
}

/// A cylinder with caps, straight or slanting: center + half * u with x² + y² <= 1 and |z| <= 1.
struct Drum {
    Vec3 center;
    Mat3 half;
};

/// The drum around a clipped surface, in the quadric's own space.
std::optional<Drum> clipped_drum(const Quadric& quadric)
{
    const auto sections = elliptic_sections(quadric);
    if (!sections)
        return std::nullopt;
    const auto& [low, high] = *quadric.z_range;
    const double middle = 0.5 * (low + high);
    const double half_height = 0.5 * (high - low);
    const auto& [center, slope, half_axes, widest, rounding] = *sections;
    const glm::dmat2 across = std::sqrt(std::max(widest, 0.0) + rounding) * half_axes;
    return Drum{
        Vec3(center + middle * slope, middle),
        Mat3(Vec3(across[0], 0.0), Vec3(across[1], 0.0), Vec3(half_height * slope, half_height))};
}

/// The box of `m * u` for all unit u.
Vec3 ellipsoid_box(const Mat3& m)
{
    return glm::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
}

/// The box of `m * u` for all u with x² + y² <= 1 and |z| <= 1.
Vec3 drum_box(const Mat3& m)
{
    return glm::sqrt(m[0] * m[0] + m[1] * m[1]) + glm::abs(m[2]);
}

/// An upper bound of LoweredQuadric::condition. Directions in canonical space have the weights of
/// `square`.
double condition_of(const Mat3& inverse, const Vec3& square)
{
    const Mat3 back = glm::inverse(inverse);
    double condition = ellipsoid_radius(inverse) * ellipsoid_radius(back);
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (square[axis] == 0.0)
            continue;
        least = std::min(least, std::abs(square[axis]));
        most = std::max(most, std::abs(square[axis]));
    }
    return condition * std::sqrt(most / least);
}

Bound bound_of(const Quadric& quadric, const CanonicalForm& form, const Mat4& transform)
{
    const Mat3 linear(transform);
    // Far more than the rounding error of the bound itself.
    constexpr double slack = 1.0 + 1e-9;
    // An ellipsoid turned inside out has an unbounded inside, and so unbounded caps.
    const bool endless = quadric.capped && form.constant > 0.0;
    if (const auto axes = endless ? std::nullopt : half_axes(form)) {
        Mat3 ellipsoid = linear * form.axes;
        for (int axis = 0; axis < 3; ++axis)
            ellipsoid[axis] *= (*axes)[axis];
        return {Vec3(transform * glm::dvec4(form.center, 1.0)), ellipsoid_radius(ellipsoid) * slack,
                ellipsoid_box(ellipsoid) * slack};
    }
    if (const auto drum = clipped_drum(quadric)) {
        return {Vec3(transform * glm::dvec4(drum->center, 1.0)),
                drum_radius(linear * drum->half) * slack, drum_box(linear * drum->half) * slack};
    }
    return {};
}

/// The inverse matrix, with each entry rounded once.
Mat3 exact_inverse(const Mat3& m)
{
    const Quad determinant = exact_determinant(m);
    Mat3 inverse;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            inverse[column][row] =
                static_cast<double>(Quad(exact_minor(m, row, column) / determinant));
    return inverse;
}

}  // namespace

std::optional<std::string> quadric_fault(const Quadric& quadric, const Mat4& transform)
{
    if (quadric.kind != QuadricKind::general)
        return std::nullopt;
    if (const auto reason = why_no_surface(canonical_form(quadric.coefficients)))
        return "the quadric has no surface: " + *reason + "; change its coefficients";
    Object object{.transform = transform};
    const LoweredQuadric placed = lower_quadric(object, quadric, 0);
    const Vec3 weights(largest_component(placed.square), std::abs(placed.linear),
                       std::abs(placed.constant));
    if (!(std::max(largest_component(placed.center), largest_component(weights)) <= largest_number))
        return "the quadric's center or axes are beyond single precision; use coefficients nearer "
               "to each other";
    if (!(std::max(weights.x, weights.y) >= smallest_length))
        return "the quadric's coefficients are too small for single precision; multiply them all";
    return std::nullopt;
}

int lower_kind(const Object& object, const Quadric& quadric, std::int32_t surface,
               SurfaceLists& lists)
{
    const bool unit_sphere = quadric.kind == QuadricKind::ellipsoid && !quadric.z_range;
    if (unit_sphere && lower_sphere(Sphere{}, object.transform, surface, lists))
        return 1;
    lists.quadrics.push_back(lower_quadric(object, quadric, surface));
    return pieces_of(lists.quadrics.back());
}

LoweredQuadric lower_quadric(const Object& object, const Quadric& quadric, std::int32_t surface)
{
    const CanonicalForm form = canonical_form(quadric.coefficients);
    const Mat3 own_from_world = exact_inverse(Mat3(object.transform));

    LoweredQuadric lowered{.center = Vec3(object.transform * glm::dvec4(form.center, 1.0)),
                           .inverse = glm::transpose(form.axes) * own_from_world,
                           .square = form.square,
                           .linear = form.linear,
                           .constant = form.constant};
    if (quadric.z_range) {
        lowered.clip = Vec3(0.0, 0.0, 1.0) * own_from_world;
        lowered.clip_base = Vec3(object.transform[3]);
        lowered.clip_low = quadric.z_range->low;
        lowered.clip_high = quadric.z_range->high;
    }
    lowered.capped = quadric.capped;
    const Bound bound = bound_of(quadric, form, object.transform);
    lowered.bound = bound.center;
    lowered.bound_radius = bound.radius;
    lowered.box_half = bound.half;
    lowered.condition = condition_of(lowered.inverse, lowered.square);
    lowered.surface = surface;
    return lowered;
}

Quadric as_quadric(const Sphere& sphere)
{
    const Vec3& c = sphere.center;
    return {.coefficients = {1, 1, 1, 0, 0, 0, -2 * c.x, -2 * c.y, -2 * c.z,
                             glm::dot(c, c) - sphere.radius * sphere.radius}};
}

Exit exit_of(const LoweredQuadric& quadric, const Vec3& eye, const Vec3& forward)
{
    const Vec3 p = quadric.inverse * (eye - quadric.center);
    const Vec3 v = quadric.inverse * forward;
    const double value =
        glm::dot(quadric.square * p, p) + 2.0 * quadric.linear * p.z + quadric.constant;
    const double height = glm::dot(quadric.clip, eye - quadric.clip_base);
    if (!(value < 0.0 && height > quadric.clip_low && height < quadric.clip_high))
        return std::nullopt;
    double first =
        first_positive_root(glm::dot(quadric.square * v, v),
                            glm::dot(quadric.square * p, v) + quadric.linear * v.z, value);
    const double climb = glm::dot(quadric.clip, forward);
    for (const double end : {quadric.clip_low, quadric.clip_high})
        if (const double t = (end - height) / climb; t > 0.0)
            first = std::min(first, t);
    return first;
}

bool is_certifiable(const LoweredQuadric& quadric)
{
    for (int row = 0; row < 3; ++row)
        if (!is_certifiable(Vec3(0.0), glm::length(glm::row(quadric.inverse, row))))
            return false;
    return is_certifiable(quadric.center, 1.0) && is_certifiable(quadric.clip_base, 1.0) &&
           (!is_bounded(quadric) || is_certifiable(quadric.bound, quadric.bound_radius));
}

bool is_bounded(const LoweredQuadric& quadric)
{
    return std::isfinite(quadric.bound_radius);
}

bool fits_tree(const LoweredQuadric& quadric)
{
    return is_bounded(quadric) && quadric.condition < worst_condition &&
           within_tree(box_of(quadric));
}

namespace {

/// Whether the coefficient a of a ray's a t² + 2 b t + c is 0 for some directions, because it is a
/// difference of squares.
bool has_asymptotes(const LoweredQuadric& quadric)
{
    const Vec3& s = quadric.square;
    return std::min({s.x, s.y, s.z}) < 0.0 && std::max({s.x, s.y, s.z}) > 0.0;
}

bool has_turned_axes(const LoweredQuadric& quadric)
{
    for (int row = 0; row < 3; ++row) {
        const Vec3 axis = glm::row(quadric.inverse, row);
        if ((axis.x != 0.0) + (axis.y != 0.0) + (axis.z != 0.0) > 1)
            return true;
    }
    return false;
}

template <class Real>
void set_sizes(abi::QuadricRecord<Real>& packed, const LoweredQuadric& quadric)
{
    const Vec3 s = glm::abs(quadric.square);
    Vec3 rows2;
    for (int row = 0; row < 3; ++row)
        rows2[row] = glm::dot(glm::row(quadric.inverse, row), glm::row(quadric.inverse, row));
    const Vec3 bend = s * rows2;
    const double lift = std::abs(quadric.linear) * std::sqrt(rows2.z);
    packed.bound_distance = static_cast<Real>(glm::distance(quadric.bound, quadric.center));
    packed.bend_size = static_cast<Real>(bend.x + bend.y + bend.z);
    packed.moment_size = static_cast<Real>(bend.y * bend.z + bend.z * bend.x + bend.x * bend.y);
    packed.turn_size = static_cast<Real>(2.0 * lift * (bend.x + bend.y));
    packed.lift_size = static_cast<Real>(lift);
    packed.clip_size = static_cast<Real>(glm::length(quadric.clip));
}

}  // namespace

template <class Real>
abi::QuadricRecord<Real> pack(const LoweredQuadric& quadric)
{
    abi::QuadricRecord<Real> packed;
    round_to(packed.center, quadric.center);
    round_to(packed.center_low, quadric.center - widen(packed.center));
    for (int row = 0; row < 3; ++row)
        round_to(packed.inverse[row], glm::row(quadric.inverse, row));
    round_to(packed.square, quadric.square);
    packed.linear = static_cast<Real>(quadric.linear);
    packed.constant = static_cast<Real>(quadric.constant);
    for (int axis = 0; axis < 3; ++axis)
        packed.counting[axis] = quadric.square[axis] != 0.0 ? Real(1) : Real(0);
    if (quadric.linear != 0.0)
        packed.counting[2] = Real(1);
    round_to(packed.clip, quadric.clip);
    round_to(packed.clip_base, quadric.clip_base);
    round_to(packed.clip_base_low, quadric.clip_base - widen(packed.clip_base));
    packed.clip_low = static_cast<Real>(quadric.clip_low);
    packed.clip_high = static_cast<Real>(quadric.clip_high);
    round_to(packed.bound, quadric.bound);
    // Enlarge the ball, because rounding moves the centre.
    const Vec3 size = glm::abs(quadric.bound);
    const double moved = 4.0 * static_cast<double>(std::numeric_limits<Real>::epsilon()) *
                         (size.x + size.y + size.z + quadric.bound_radius);
    packed.bound_radius = static_cast<Real>(quadric.bound_radius + moved);
    set_sizes(packed, quadric);
    packed.clipped = quadric.clipped() ? 1 : 0;
    packed.capped = quadric.capped ? 1 : 0;
    packed.has_asymptotes = has_asymptotes(quadric) ? 1 : 0;
    // Not in single precision, which would lose too many digits with Accuracy::fast.
    packed.turned =
        sizeof(Real) == sizeof(double) && has_asymptotes(quadric) && has_turned_axes(quadric);
    packed.surface = quadric.surface;
    return packed;
}

template abi::QuadricRecord<float> pack(const LoweredQuadric&);
template abi::QuadricRecord<double> pack(const LoweredQuadric&);

}  // namespace packtrace
