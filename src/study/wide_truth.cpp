#include "study/wide_truth.hpp"

#include <algorithm>
#include <limits>

namespace packtrace::study {
namespace {

using boost::multiprecision::abs;
using boost::multiprecision::sqrt;
using reference::dot;

constexpr double never = std::numeric_limits<double>::infinity();

/// A coordinate in own space is a sum of three products, each rounded up to three times.
const Wide own_roundings = 3;

/// The sums of magnitudes that a matrix makes of a vector.
WideVec sizes(const WideVec (&rows)[3], const WideVec& v)
{
    const WideVec size = magnitudes(v);
    return {dot(magnitudes(rows[0]), size), dot(magnitudes(rows[1]), size),
            dot(magnitudes(rows[2]), size)};
}

/// One ray against one surface.
class Line {
public:
    Line(const WideSurface& surface, const StressRay& ray)
        : surface_(surface),
          org_(wide(ray.org)),
          dir_(wide(ray.dir)),
          p_(surface.point_to_own(org_)),
          v_(surface.direction_to_own(dir_)),
          t_min_(ray.t_min),
          t_max_(ray.t_max)
    {
        const WideVec second = surface.second_order(v_);
        a_ = dot(second, v_);
        b_ = dot(surface.gradient(p_), v_);
        c_ = surface.value(p_);
        infinity_margin_ = margin_of_infinity(second);
    }

    void find(std::vector<Meeting>& found) const
    {
        find_sides(found);
        if (surface_.capped) {
            find_cap(surface_.z_range->low, Wide(-1), found);
            find_cap(surface_.z_range->high, Wide(1), found);
        }
    }

private:
    [[nodiscard]] WideVec own_at(const Wide& t) const
    {
        return p_ + t * v_;
    }

    /// What relative changes of the inputs by 1 move along the own covector g, at t. Inputs are
    /// the ray, the surface's place, its transform, and the ray's start and way in own space.
    [[nodiscard]] Wide reach(const WideVec& g, const Wide& t, const WideVec& own) const
    {
        const WideVec n = magnitudes(surface_.covector_to_world(g));
        const Wide by_place = dot(n, magnitudes(org_) + magnitudes(t * dir_) + surface_.place);
        if (!surface_.by_points)
            return by_place;
        const WideVec way = magnitudes(org_ - surface_.offset) + magnitudes(t * dir_);
        return by_place + dot(n, sizes(surface_.world, own)) +
               own_roundings * dot(magnitudes(g), sizes(surface_.own, way));
    }

    /// What a general quadric's canonical form adds to `reach`, and to the change of its half
    /// value: its centre, axes and coefficients, and the ray's start and way in its space.
    [[nodiscard]] Wide canonical_terms(const WideVec& g, const Wide& t) const
    {
        const CanonicalForm& form = *surface_.canonical;
        const WideVec center = wide(form.center);
        const WideVec way = magnitudes(p_) + magnitudes(center) + magnitudes(t * v_);
        const WideVec off = own_at(t) - center;
        Wide sum = abs(Wide(form.constant)) / 2;
        for (int axis = 0; axis < 3; ++axis) {
            const WideVec row = wide(form.axes[axis]);
            const Wide x = dot(row, off);
            sum += abs(dot(row, g)) * dot(magnitudes(row), way) +
                   abs(Wide(form.square[axis])) * x * x / 2 +
                   (axis == 2 ? abs(Wide(form.linear) * x) : Wide(0));
        }
        // The form itself comes from an eigenvalue problem and completed squares.
        return 2 * own_roundings * sum;
    }

    /// How much the half value can change at t.
    [[nodiscard]] Wide sensitivity(const Wide& t) const
    {
        const WideVec own = own_at(t);
        const WideVec g = surface_.gradient(own);
        return reach(g, t, own) + (surface_.canonical ? canonical_terms(g, t) : Wide(0));
    }

    /// How near the quadratic is to losing a root to infinity.
    [[nodiscard]] double margin_of_infinity(const WideVec& second) const
    {
        const WideVec n = magnitudes(surface_.covector_to_world(second));
        Wide size = 2 * dot(n, magnitudes(dir_));
        if (surface_.by_points)
            size += 2 * (dot(n, sizes(surface_.world, v_)) +
                         own_roundings * dot(magnitudes(second), sizes(surface_.own, dir_)));
        return size == 0 ? never : static_cast<double>(abs(a_) / size);
    }

    /// How near a is to vanishing where none of its terms cancel: all of them must.
    [[nodiscard]] double margin_of_vanishing(const WideVec& second) const
    {
        const WideVec by_transform = sizes(surface_.world, v_);
        const WideVec size = sizes(surface_.own, magnitudes(dir_) + by_transform) +
                             own_roundings * sizes(surface_.own, dir_);
        const auto share = [](const Wide& term, const Wide& v, const Wide& reach) {
            return term == 0 ? Wide(0) : Wide(abs(v) / reach);
        };
        return static_cast<double>(
            std::max({share(second.x, v_.x, size.x), share(second.y, v_.y, size.y),
                      share(second.z, v_.z, size.z)}));
    }

    /// How near a ray without a root is to one far away. There a and c have one sign; a change
    /// that turns a's leaves a root ahead, at any distance. Where no terms of a cancel, as along a
    /// cylinder, it cannot turn, but can vanish; from there any turn towards the surface meets it.
    [[nodiscard]] double margin_of_no_root() const
    {
        if (t_max_ < never || !surface_.by_points)
            return never;
        const WideVec second = surface_.second_order(v_);
        const WideVec terms = second * v_;
        const bool cancels = a_ > 0 ? std::min({terms.x, terms.y, terms.z}) < 0
                                    : std::max({terms.x, terms.y, terms.z}) > 0;
        return cancels ? infinity_margin_ : margin_of_vanishing(second);
    }

    [[nodiscard]] double touching_margin() const
    {
        if (a_ == 0)
            return never;
        const Wide t = -b_ / a_;
        const Wide half_value = (c_ - b_ * b_ / a_) / 2;
        return static_cast<double>(abs(half_value) / sensitivity(t));
    }

    /// Adds the meeting at t, whose own uncertainty is `spread`; `margin` holds so far.
    void add(const Wide& t, const Wide& spread, const WideVec& world_normal, bool exists,
             double margin, std::vector<Meeting>& found) const
    {
        Meeting meeting;
        meeting.t = t;
        meeting.object = surface_.object;
        meeting.exists = exists && t > t_min_ && t < t_max_;
        const Wide size = sqrt(dot(world_normal, world_normal));
        if (size > 0)
            meeting.normal = world_normal / size;
        if (spread > 0) {
            const double start = static_cast<double>(abs(t - t_min_) / spread);
            (t_min_ == 0 ? margin : meeting.end_margin) = std::min(margin, start);
            if (t_max_ < never)
                meeting.end_margin = std::min(meeting.end_margin,
                                              static_cast<double>(abs(t - Wide(t_max_)) / spread));
        }
        meeting.condition = static_cast<double>(spread / abs(t));
        meeting.margin = margin;
        found.push_back(meeting);
    }

    void add_side(const Wide& t, double margin, bool crosses, std::vector<Meeting>& found) const
    {
        const WideVec own = own_at(t);
        const WideVec g = surface_.gradient(own);
        const WideVec n = surface_.covector_to_world(g);
        const Wide slope = abs(dot(g, v_));
        // Where the ray only touches, or nearly, t has no first-order uncertainty.
        const Wide spread = crosses && slope > 0 ? Wide(sensitivity(t) / slope) : Wide(0);
        bool exists = crosses;
        if (surface_.z_range) {
            const Wide blur = reach({0, 0, 1}, t, own) + abs(v_.z) * spread;
            for (const double bound : {surface_.z_range->low, surface_.z_range->high})
                margin = std::min(margin, static_cast<double>(abs(own.z - bound) / blur));
            exists = exists && own.z >= surface_.z_range->low && own.z <= surface_.z_range->high;
        }
        add(t, spread, n, exists, margin, found);
    }

    void find_sides(std::vector<Meeting>& found) const
    {
        const Wide discriminant = b_ * b_ - a_ * c_;
        const double touching = touching_margin();
        if (discriminant < 0) {
            add_side(-b_ / a_, std::min(touching, margin_of_no_root()), false, found);
            return;
        }
        const Wide root = sqrt(discriminant);
        const Wide q = b_ < 0 ? Wide(root - b_) : Wide(-root - b_);
        if (q != 0)
            add_side(c_ / q, touching, true, found);
        if (a_ != 0)
            add_side(q / a_, std::min(touching, infinity_margin_), true, found);
    }

    void find_cap(double height, const Wide& side, std::vector<Meeting>& found) const
    {
        if (v_.z == 0)
            return;
        const Wide t = (Wide(height) - p_.z) / v_.z;
        const WideVec own = own_at(t);
        const WideVec up = surface_.covector_to_world({0, 0, side});
        const Wide spread = reach({0, 0, side}, t, own) / abs(v_.z);
        const Wide value = surface_.value(own) / 2;
        const Wide change = abs(dot(surface_.gradient(own), v_)) * spread;
        const double margin = static_cast<double>(abs(value) / (sensitivity(t) + change));
        add(t, spread, up, value <= 0, margin, found);
    }

    const WideSurface& surface_;
    WideVec org_;
    WideVec dir_;
    WideVec p_;
    WideVec v_;
    double t_min_;
    double t_max_;
    Wide a_ = 0;
    Wide b_ = 0;
    Wide c_ = 0;
    double infinity_margin_ = 0.0;
};

}  // namespace

void find_meetings(const WideSurface& surface, const StressRay& ray, std::vector<Meeting>& found)
{
    Line(surface, ray).find(found);
}

double distance_to(const WideSurface& surface, const WideVec& P)
{
    const WideVec own = surface.point_to_own(P);
    const WideVec n = surface.covector_to_world(surface.gradient(own));
    const Wide size = sqrt(dot(n, n));
    Wide distance = size > 0 ? Wide(abs(surface.value(own) / (2 * size))) : Wide(0);
    if (surface.capped) {
        const WideVec up = surface.covector_to_world({0, 0, 1});
        const Wide height = sqrt(dot(up, up));
        for (const double cap : {surface.z_range->low, surface.z_range->high})
            distance = std::min(distance, Wide(abs(own.z - cap) / height));
    }
    return static_cast<double>(distance);
}

}  // namespace packtrace::study
