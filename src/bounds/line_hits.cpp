#include "bounds/line_hits.hpp"

#include "bounds/exact_surface.hpp"
#include "bounds/quadratic_roots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace packtrace::bounds {
namespace {

using reference::dot;

/// Whether a condition is proven false, undecided, or proven true.
enum class Proof { no, open, yes };

Proof is_between(const Ball& x, double low, double high)
{
    const Ball above = x - Ball(low);
    const Ball below = Ball(high) - x;
    if (is_negative(above) || is_negative(below))
        return Proof::no;
    const bool at_end = is_zero(above) || is_zero(below);
    return (is_positive(above) || at_end) && (is_positive(below) || at_end) ? Proof::yes
                                                                            : Proof::open;
}

/// A ball that holds an interval.
Ball ball_of(Quad low, Quad high)
{
    const Quad middle = (low + high) / 2;
    return {middle, static_cast<double>(high - middle) * inflation + size_of(middle) * 0x1p-110};
}

/// A line in the space of one surface. `dir` has a length near 1 in the world, so that its squares
/// neither overflow nor underflow; t counts in lengths of `dir`.
class OwnLine {
public:
    OwnLine(const ExactSurface& surface, const Vec3& org, const BallVec& dir)
        : surface_(surface),
          p_(surface.point_to_own(org)),
          v_(surface.direction_to_own(dir)),
          a_(dot(surface.second_order(v_), v_))
    {
    }

    [[nodiscard]] std::vector<HitInterval> hits() const
    {
        std::vector<HitInterval> found;
        if (surface_.sheets) {
            for (const BallVec& sheet : *surface_.sheets)
                add_plane(dot(sheet, p_), dot(sheet, v_), found);
            return found;
        }
        if (!surface_.edges.empty()) {
            add_polygon(found);
            return found;
        }
        add_sides(found);
        if (surface_.capped) {
            add_cap(surface_.z_range->low, found);
            add_cap(surface_.z_range->high, found);
        }
        return found;
    }

    /// Whether the line is inside a capped body at t.
    [[nodiscard]] Proof inside(Quad t) const
    {
        const BallVec p = at(Ball(t, 0.0));
        const Ball value = surface_.value(p);
        const Proof z = is_between(p.z, surface_.z_range->low, surface_.z_range->high);
        if (is_positive(value) || z == Proof::no)
            return Proof::no;
        return is_negative(value) ? z : Proof::open;
    }

private:
    [[nodiscard]] BallVec at(const Ball& t) const
    {
        return p_ + t * v_;
    }

    [[nodiscard]] Quadratic from(Quad t) const
    {
        const BallVec p = at(Ball(t, 0.0));
        return {a_, dot(surface_.gradient(p), v_), surface_.value(p)};
    }

    /// The t nearest to the origin of the surface's own space.
    [[nodiscard]] Quad start() const
    {
        const auto t = static_cast<double>((-dot(p_, v_) / dot(v_, v_)).mid);
        return std::isfinite(t) ? Quad(t) : Quad(0);
    }

    void add_sides(std::vector<HitInterval>& found) const
    {
        for (const RootInterval& root : roots_of([this](Quad t) { return from(t); }, start())) {
            HitInterval hit{root.low, root.high, root.certain, root.roots};
            const Proof in_range = in_z_range(hit);
            if (in_range == Proof::no)
                continue;
            hit.certain = hit.certain && in_range == Proof::yes;
            found.push_back(hit);
        }
    }

    [[nodiscard]] Proof in_z_range(const HitInterval& hit) const
    {
        if (!surface_.z_range)
            return Proof::yes;
        const bool ends = hit.high < Quad(infinity);
        const bool begins = hit.low > -Quad(infinity);
        if (ends && begins)
            return is_between(at(ball_of(hit.low, hit.high)).z, surface_.z_range->low,
                              surface_.z_range->high);
        if (ends == begins)
            return Proof::open;
        return stays_out(at(Ball(begins ? hit.low : hit.high, 0.0)).z, begins ? v_.z : -v_.z)
                   ? Proof::no
                   : Proof::open;
    }

    /// Whether a line that starts at height `z` and climbs by `climb` surely never enters the z
    /// range.
    [[nodiscard]] bool stays_out(const Ball& z, const Ball& climb) const
    {
        return (is_positive(climb) && is_positive(z - Ball(surface_.z_range->high))) ||
               (is_negative(climb) && is_positive(Ball(surface_.z_range->low) - z));
    }

    void add_cap(double height, std::vector<HitInterval>& found) const
    {
        std::vector<HitInterval> plane_hits;
        add_plane(p_.z - Ball(height), v_.z, plane_hits);
        for (HitInterval& hit : plane_hits) {
            if (hit.certain) {
                const Ball value = surface_.value(at(ball_of(hit.low, hit.high)));
                if (is_positive(value))
                    continue;
                hit.certain = is_negative(value) || is_zero(value);
            }
            found.push_back(hit);
        }
    }

    void add_polygon(std::vector<HitInterval>& found) const
    {
        const Proof inside = within_edges();
        if (inside == Proof::no)
            return;
        std::vector<HitInterval> plane_hits;
        add_plane(surface_.value(p_), dot(surface_.linear + surface_.linear, v_), plane_hits);
        for (HitInterval& hit : plane_hits) {
            hit.certain = hit.certain && inside == Proof::yes;
            found.push_back(hit);
        }
    }

    /// Whether the line passes through a polygon, by the even-odd rule. The rule counts edges along
    /// a half axis across the line. The first of four half axes that touches no end of an edge
    /// decides.
    [[nodiscard]] Proof within_edges() const
    {
        const Ball v[3] = {v_.x, v_.y, v_.z};
        int along = magnitude(v[1].mid) > magnitude(v[0].mid) ? 1 : 0;
        along = magnitude(v[2].mid) > magnitude(v[along].mid) ? 2 : along;
        for (const int turn : {0, 1, 2, 3})
            if (const Proof inside = crossing_parity(along, turn); inside != Proof::open)
                return inside;
        return Proof::open;
    }

    /// An edge's end projected along the line onto the other two axes, times the component `along`
    /// of the line.
    [[nodiscard]] std::array<Ball, 2> across(const BallVec& end, int along) const
    {
        const BallVec off = end - p_;
        const Ball q[3] = {off.x, off.y, off.z};
        const Ball v[3] = {v_.x, v_.y, v_.z};
        const int x = (along + 1) % 3;
        const int y = (along + 2) % 3;
        return {q[x] * v[along] - v[x] * q[along], q[y] * v[along] - v[y] * q[along]};
    }

    [[nodiscard]] Proof crossing_parity(int along, int turn) const
    {
        bool odd = false;
        for (const auto& [from, to] : surface_.edges) {
            std::array<std::array<Ball, 2>, 2> ends{across(from, along), across(to, along)};
            for (auto& end : ends)
                for (int quarter = 0; quarter < turn; ++quarter)
                    end = {-end[1], end[0]};
            const Proof crosses = crosses_half_axis(ends[0], ends[1]);
            if (crosses == Proof::open)
                return Proof::open;
            odd ^= crosses == Proof::yes;
        }
        return odd ? Proof::yes : Proof::no;
    }

    static Proof crosses_half_axis(const std::array<Ball, 2>& a, const std::array<Ball, 2>& b)
    {
        if (is_negative(a[0]) && is_negative(b[0]))
            return Proof::no;
        if ((is_positive(a[1]) && is_positive(b[1])) || (is_negative(a[1]) && is_negative(b[1])))
            return Proof::no;
        if (!has_sign(a[1]) || !has_sign(b[1]))
            return Proof::open;
        const Ball side = a[0] * b[1] - b[0] * a[1];
        if (!has_sign(side))
            return Proof::open;
        return is_positive(side) == is_positive(b[1]) ? Proof::yes : Proof::no;
    }

    /// Where height + t slope is 0.
    static void add_plane(const Ball& height, const Ball& slope, std::vector<HitInterval>& found)
    {
        if (is_zero(slope))
            return;
        const Ball t = -height / slope;
        const Quad low = lower_end(t);
        const Quad high = upper_end(t);
        if (low <= high)
            found.push_back({.low = low, .high = high, .certain = true});
        else
            found.push_back({.low = -Quad(infinity), .high = Quad(infinity), .certain = false});
    }

    const ExactSurface& surface_;
    BallVec p_;
    BallVec v_;
    Ball a_;
};

/// A power of two near the length of a direction.
int exponent_of(const Vec3& dir)
{
    return std::ilogb(std::max({std::abs(dir.x), std::abs(dir.y), std::abs(dir.z)}));
}

Quad scaled(Quad x, int exponent)
{
    // Twice, as the power itself may be out of double's range.
    const int half = exponent / 2;
    return x * Quad(std::ldexp(1.0, half)) * Quad(std::ldexp(1.0, exponent - half));
}

/// An interval joined with the following ones that overlap it, or that overlap one of those.
struct Cluster {
    HitInterval all;
    std::size_t end;  ///< index of the first interval behind the cluster
};

Cluster cluster_from(const std::vector<HitInterval>& hits, std::size_t first)
{
    Cluster cluster{hits[first], first + 1};
    for (; cluster.end < hits.size() && hits[cluster.end].low <= cluster.all.high; ++cluster.end) {
        const HitInterval& more = hits[cluster.end];
        cluster.all.high = std::max(cluster.all.high, more.high);
        cluster.all.certain = cluster.all.certain || more.certain;
        cluster.all.hits += more.hits;
    }
    return cluster;
}

/// Of a closed body: intervals that overlap, such as those of side and cap at a rim, become one
/// certain interval where the line is proven inside the body before them and outside behind them,
/// or the other way round.
void prove_crossings(const OwnLine& line, std::vector<HitInterval>& hits)
{
    Quad last = 0;
    for (std::size_t first = 0; first < hits.size(); ++first) {
        auto [all, end] = cluster_from(hits, first);
        const Quad apart = magnitude(all.low) + magnitude(all.high) + 1;
        const Quad before = first > 0 ? (last + all.low) / 2 : all.low - apart;
        const Quad behind = end < hits.size() ? (hits[end].low + all.high) / 2 : all.high + apart;
        last = all.high;
        if (!all.certain && magnitude(before) < Quad(infinity) &&
            magnitude(behind) < Quad(infinity)) {
            const Proof was = line.inside(before);
            const Proof is = line.inside(behind);
            all.certain = was != Proof::open && is != Proof::open && was != is;
        }
        if (all.certain) {
            hits[first] = all;
            hits.erase(hits.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                       hits.begin() + static_cast<std::ptrdiff_t>(end));
        } else {
            first = end - 1;
        }
    }
}

}  // namespace

std::vector<HitInterval> line_hits(const Surface& from, const Mat4& transform, const Line& line)
{
    if (line.dir == Vec3(0.0))
        return {};
    const ExactSurface surface(from, transform);
    const int exponent = exponent_of(line.dir);
    BallVec dir;
    Ball* const components[3] = {&dir.x, &dir.y, &dir.z};
    for (int axis = 0; axis < 3; ++axis)
        *components[axis] = Ball(scaled(Quad(line.dir[axis]), -exponent), 0.0);
    const OwnLine own(surface, line.org, dir);
    std::vector<HitInterval> hits = own.hits();
    std::sort(hits.begin(), hits.end(),
              [](const HitInterval& a, const HitInterval& b) { return a.low < b.low; });
    if (surface.capped)
        prove_crossings(own, hits);
    for (HitInterval& hit : hits) {
        hit.low = scaled(hit.low, -exponent);
        hit.high = scaled(hit.high, -exponent);
    }
    return hits;
}

}  // namespace packtrace::bounds
