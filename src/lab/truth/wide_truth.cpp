#include "lab/truth/wide_truth.hpp"

#include "lab/truth/sensitivity.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace packtrace::lab {
namespace {

using reference::dot;

constexpr double never = std::numeric_limits<double>::infinity();

/// A bound of the roundings of a polygon's normal, which is a sum of cross products of edges.
constexpr double normal_roundings = 8.0;

/// Half values below this share of c are what rounding to 113 bits leaves of 0.
constexpr double wide_rounding = 0x1p-104;

/// One ray against one surface.
class Line {
public:
    Line(const WideSurface& surface, const StressRay& ray)
        : surface_(surface),
          sensitivity_(surface, ray),
          p_(surface.point_to_own(wide(ray.org))),
          v_(surface.direction_to_own(wide(ray.dir))),
          own_dir_(narrow(v_)),
          t_min_(ray.t_min),
          t_max_(ray.t_max)
    {
        const WideVec second = surface.second_order(v_);
        a_ = dot(second, v_);
        b_ = dot(surface.gradient(p_), v_);
        c_ = surface.value(p_);
        infinity_margin_ = margin_of_infinity(second);
        const Vec3 size = glm::abs(own_dir_);
        widest_ = size.y > size.x ? 1 : 0;
        widest_ = size.z > size[widest_] ? 2 : widest_;
    }

    void find(std::vector<TrueHit>& found) const
    {
        if (surface_.sheets) {
            for (const std::size_t sheet : {std::size_t{0}, std::size_t{1}})
                find_sheet((*surface_.sheets)[sheet], (*surface_.sheets)[1 - sheet], found);
            return;
        }
        if (!surface_.edges.empty()) {
            find_polygon(found);
            return;
        }
        find_sides(found);
        if (surface_.capped) {
            find_cap(surface_.z_range->low, -1, found);
            find_cap(surface_.z_range->high, 1, found);
        }
    }

private:
    [[nodiscard]] WideVec own_at(const Wide& t) const
    {
        return p_ + t * v_;
    }

    [[nodiscard]] Vec3 to_world(const WideVec& g) const
    {
        return narrow(surface_.covector_to_world(g));
    }

    /// How much the own covector g times the point at t changes, for relative changes 1 of every
    /// input.
    [[nodiscard]] double change_along(const WideVec& g, const Wide& t, const WideVec& own) const
    {
        return sensitivity_.at(narrow(g), to_world(g), narrow(t), narrow(own));
    }

    /// What a general quadric's canonical form adds to the change of its half value: by its centre,
    /// axes and coefficients, and by the ray's start and way in its space.
    [[nodiscard]] double canonical_terms(const Vec3& g, const Wide& t, const WideVec& own) const
    {
        const CanonicalForm& form = *surface_.canonical;
        const Vec3 way = sizes(p_) + glm::abs(form.center) + std::abs(narrow(t)) * sizes(v_);
        const Vec3 off = narrow(own - wide(form.center));
        double sum = std::abs(form.constant) / 2.0;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3& row = form.axes[axis];
            const double x = glm::dot(row, off);
            sum += std::abs(glm::dot(row, g)) * glm::dot(glm::abs(row), way) +
                   std::abs(form.square[axis]) * x * x / 2.0 +
                   (axis == 2 ? std::abs(form.linear * x) : 0.0);
        }
        // The form itself comes from an eigenvalue problem and completed squares.
        return 2.0 * own_roundings * sum;
    }

    /// How much the half value at t changes.
    [[nodiscard]] double change_at(const WideVec& g, const Wide& t, const WideVec& own) const
    {
        return change_along(g, t, own) +
               (surface_.canonical ? canonical_terms(narrow(g), t, own) : 0.0);
    }

    /// How much the height in own space at t changes. Of a general quadric the height is relative
    /// to the centre of the canonical form, which may be far away.
    [[nodiscard]] double change_of_height(const Wide& t, const WideVec& own) const
    {
        const WideVec up(0, 0, 1);
        const double center =
            surface_.canonical
                ? sensitivity_.of_center(to_world(up), glm::abs(surface_.canonical->center))
                : 0.0;
        return change_along(up, t, own) + center;
    }

    /// Relative change of the inputs that makes a vanish, so that a root goes to infinity.
    [[nodiscard]] double margin_of_infinity(const WideVec& second) const
    {
        const double size =
            2.0 * sensitivity_.of_direction(narrow(second), to_world(second), own_dir_);
        return size == 0.0 ? never : std::abs(narrow(a_)) / size;
    }

    /// The same where no terms of a cancel: all of them must vanish.
    [[nodiscard]] double margin_of_vanishing(const WideVec& second) const
    {
        const Vec3 size = sensitivity_.of_components(own_dir_);
        double margin = 0.0;
        const Vec3 terms = narrow(second);
        for (int axis = 0; axis < 3; ++axis)
            if (terms[axis] != 0.0)
                margin = std::max(margin, std::abs(own_dir_[axis]) / size[axis]);
        return margin;
    }

    /// Relative change of the inputs that gives a ray without a root one far away. There a and c
    /// have the same sign; a change of a's sign gives a root ahead, at any distance. Where no terms
    /// of a cancel, as along a cylinder, its sign cannot change, but a can vanish; then any turn
    /// towards the surface hits it.
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

    /// Relative change of the inputs that makes the ray touch the surface.
    [[nodiscard]] double touching_margin() const
    {
        if (a_ == 0)
            return never;
        const Wide t = -b_ / a_;
        const WideVec own = own_at(t);
        const double half_value = narrow((c_ + t * b_) / 2);
        // Through an apex both this and its change are 0, up to rounding.
        if (std::abs(half_value) <= wide_rounding * std::abs(narrow(c_)))
            return 0.0;
        return std::abs(half_value) / change_at(surface_.gradient(own), t, own);
    }

    /// Adds the hit at t, with the change `spread` of t. `margin` does not consider the start of
    /// the ray interval yet.
    TrueHit& add(const Wide& t, double spread, const WideVec& normal, bool exists, double margin,
                 std::vector<TrueHit>& found) const
    {
        TrueHit hit;
        hit.t = t;
        hit.object = surface_.object;
        hit.exists = exists && t > t_min_ && t < t_max_;
        const WideVec n = surface_.covector_to_world(normal);
        const Wide size = square_root(dot(n, n));
        if (size > 0)
            hit.normal = n / size;
        const double size_of_t = std::abs(narrow(t));
        if (t_min_ > 0)
            hit.end_gap = std::abs(narrow(t - t_min_)) / size_of_t;
        else if (spread > 0)
            margin = std::min(margin, size_of_t / spread);
        if (t_max_ < never)
            hit.end_gap = std::min(hit.end_gap, std::abs(narrow(t - t_max_)) / size_of_t);
        hit.spread = spread;
        hit.condition = spread / size_of_t;
        hit.margin = margin;
        found.push_back(hit);
        return found.back();
    }

    /// What a place on the side is: a root, or the place where a ray without a root is nearest.
    enum class Place { root, nearest };

    void add_side(const Wide& t, double margin, Place place, std::vector<TrueHit>& found) const
    {
        const WideVec own = own_at(t);
        const WideVec g = surface_.gradient(own);
        const double slope = std::abs(narrow(dot(g, v_)));
        bool exists = place == Place::root;
        // Where the ray only touches, or nearly, t has no first-order change.
        const double spread = exists && slope > 0.0 ? change_at(g, t, own) / slope : 0.0;
        if (surface_.z_range) {
            const double blur = change_of_height(t, own) + std::abs(own_dir_.z) * spread;
            for (const double bound : {surface_.z_range->low, surface_.z_range->high})
                margin = std::min(margin, std::abs(narrow(own.z - bound)) / blur);
            exists = exists && own.z >= surface_.z_range->low && own.z <= surface_.z_range->high;
        }
        TrueHit& hit = add(t, spread, g, exists, margin, found);
        hit.normal_spread = turn_of_normal(g, t, own, spread);
    }

    /// How much the normal turns for relative changes 1 of every input: because its point moves
    /// along the ray, and because it is computed from the point.
    [[nodiscard]] double turn_of_normal(const WideVec& g, const Wide& t, const WideVec& own,
                                        double spread) const
    {
        const double size = glm::length(to_world(g));
        if (size == 0.0)
            return never;
        const Vec3 way = sizes(p_) + std::abs(narrow(t)) * sizes(v_) + sizes(own);
        Vec3 terms = sizes(surface_.linear);
        for (int row = 0; row < 3; ++row)
            terms[row] += glm::dot(sizes(surface_.square[row]), own_roundings * way);
        const double along = glm::length(to_world(surface_.second_order(v_))) * spread;
        return (along + glm::length(sensitivity_.covector(terms))) / size;
    }

    void find_sides(std::vector<TrueHit>& found) const
    {
        const Wide discriminant = b_ * b_ - a_ * c_;
        const double touching = touching_margin();
        if (discriminant < 0) {
            add_side(-b_ / a_, std::min(touching, margin_of_no_root()), Place::nearest, found);
            return;
        }
        const Wide root = square_root(discriminant);
        const Wide q = b_ < 0 ? Wide(root - b_) : Wide(-root - b_);
        if (q != 0)
            add_side(c_ / q, touching, Place::root, found);
        if (a_ != 0)
            add_side(q / a_, std::min(touching, infinity_margin_), Place::root, found);
    }

    /// One of two crossing planes. Every line that is parallel to neither hits both, so that no
    /// change of the inputs makes a ray miss at their edge, but a change may choose the other
    /// normal.
    void find_sheet(const WideVec& g, const WideVec& other, std::vector<TrueHit>& found) const
    {
        const Wide slope = dot(g, v_);
        if (slope == 0)
            return;
        const Wide t = -dot(g, p_) / slope;
        const WideVec own = own_at(t);
        const double steep = std::abs(narrow(slope));
        const double spread = change_along(g, t, own) / steep;
        const double turn = sensitivity_.of_direction(narrow(g), to_world(g), own_dir_);
        const Wide side = dot(other, own);
        constexpr bool exists = true;
        TrueHit& hit = add(t, spread, side > 0 ? g : -g, exists, steep / turn, found);
        const double blur = change_along(other, t, own) + std::abs(narrow(dot(other, v_))) * spread;
        hit.side_margin = std::abs(narrow(side)) / blur;
        limit_to_quadratic(hit);
    }

    /// A solver that treats two crossing planes as one quadratic loses digits of a for rays along
    /// either plane, and so digits of the other plane's t.
    void limit_to_quadratic(TrueHit& hit) const
    {
        const Vec3 terms = narrow(surface_.second_order(v_) * v_);
        const double size = std::abs(terms.x) + std::abs(terms.y) + std::abs(terms.z);
        if (a_ == 0)
            return;
        hit.condition = std::max(hit.condition, own_roundings * size / std::abs(narrow(a_)));
        hit.spread = hit.condition * std::abs(narrow(hit.t));
    }

    /// The hit of a polygon's plane. It exists by the even-odd rule across the line. Its margin is
    /// the distance of the nearest edge over how much a change of the inputs moves the hit.
    void find_polygon(std::vector<TrueHit>& found) const
    {
        const WideVec g = surface_.linear;
        const Wide slope = dot(g, v_);
        if (slope == 0)
            return;
        const Wide t = -(c_ / 2) / slope;
        const WideVec own = own_at(t);
        const double steep = std::abs(narrow(slope));
        const double spread = change_along(g, t, own) / steep;
        const double turn = sensitivity_.of_direction(narrow(g), to_world(g), own_dir_);
        bool inside = false;
        double margin = steep / turn;
        for (const auto& [from, to] : surface_.edges) {
            inside ^= crosses_positive_x(across(from), across(to));
            margin = std::min(margin, margin_of_edge(from, to, t, own));
        }
        TrueHit& hit = add(t, spread, g, inside, margin, found);
        hit.normal_spread = normal_roundings;
    }

    /// P relative to the line, projected along the line's largest component; two coordinates.
    [[nodiscard]] WideVec across(const WideVec& P) const
    {
        const WideVec off = P - p_;
        const Wide p[3] = {off.x, off.y, off.z};
        const Wide v[3] = {v_.x, v_.y, v_.z};
        const int x = (widest_ + 1) % 3;
        const int y = (widest_ + 2) % 3;
        return {p[x] - v[x] / v[widest_] * p[widest_], p[y] - v[y] / v[widest_] * p[widest_], 0};
    }

    static bool crosses_positive_x(const WideVec& a, const WideVec& b)
    {
        if ((a.y > 0) == (b.y > 0))
            return false;
        const WideVec& lower = a.y > 0 ? b : a;
        const WideVec& upper = a.y > 0 ? a : b;
        return lower.x * upper.y > upper.x * lower.y;
    }

    /// Relative change of the inputs that brings the line to an edge.
    [[nodiscard]] double margin_of_edge(const WideVec& from, const WideVec& to, const Wide& t,
                                        const WideVec& own) const
    {
        const WideVec a = across(from);
        const WideVec way = across(to) - a;
        const Wide length2 = dot(way, way);
        const Wide share =
            length2 > 0 ? std::clamp(Wide(-dot(a, way) / length2), Wide(0), Wide(1)) : Wide(0);
        const WideVec nearest = a + share * way;
        const double distance = narrow(square_root(dot(nearest, nearest)));
        double blur = 0.0;
        for (const int axis : {(widest_ + 1) % 3, (widest_ + 2) % 3}) {
            Wide unit[3] = {0, 0, 0};
            unit[axis] = 1;
            const Wide v[3] = {v_.x, v_.y, v_.z};
            unit[widest_] = -v[axis] / v[widest_];
            blur += change_along({unit[0], unit[1], unit[2]}, t, own);
        }
        return distance / blur;
    }

    void find_cap(double height, int side, std::vector<TrueHit>& found) const
    {
        if (v_.z == 0)
            return;
        const Wide t = (Wide(height) - p_.z) / v_.z;
        const WideVec own = own_at(t);
        const WideVec up(0, 0, side);
        const double spread = change_of_height(t, own) / std::abs(own_dir_.z);
        const Wide value = surface_.value(own) / 2;
        const WideVec g = surface_.gradient(own);
        const double change = std::abs(narrow(dot(g, v_))) * spread;
        TrueHit& hit = add(t, spread, up, value <= 0,
                           std::abs(narrow(value)) / (change_at(g, t, own) + change), found);
        hit.piece = side < 0 ? 1 : 2;
    }

    const WideSurface& surface_;
    Sensitivity sensitivity_;
    WideVec p_;
    WideVec v_;
    Vec3 own_dir_;
    double t_min_;
    double t_max_;
    Wide a_ = 0;
    Wide b_ = 0;
    Wide c_ = 0;
    double infinity_margin_ = 0.0;
    int widest_ = 0;  ///< the axis of the direction's largest component
};

}  // namespace

void find_true_hits(const WideSurface& surface, const StressRay& ray, std::vector<TrueHit>& found)
{
    Line(surface, ray).find(found);
}

}  // namespace packtrace::lab
