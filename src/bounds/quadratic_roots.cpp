#include "bounds/quadratic_roots.hpp"

#include <algorithm>

namespace packtrace::bounds {
namespace {

using From = std::function<Quadratic(Quad)>;

/// For at most `roots` roots of which nothing else is known.
RootInterval anywhere(int roots)
{
    return {-Quad(infinity), Quad(infinity), false, roots};
}

/// An interval of one certain root at t plus a ball; infinite where nothing is known of the ball.
RootInterval around(Quad t, const Ball& s)
{
    const Ball sum = Ball(t, 0.0) + s;
    const Quad low = lower_end(sum);
    const Quad high = upper_end(sum);
    if (!(low <= high))
        return {-Quad(infinity), Quad(infinity), true, 1};
    return {low, high, true, 1};
}

Ball discriminant(const Quadratic& f)
{
    return f.b * f.b - f.a * f.c;
}

/// -(b ± √D), without cancellation, for b with a sign.
Ball vieta_sum(const Ball& b, const Ball& root)
{
    return is_positive(b) ? -(b + root) : root - b;
}

/// The sign of a quadratic's slope at a root.
enum class Slope { falling, rising };

/// For b with a sign.
Slope slope_of(const Ball& b)
{
    return is_positive(b) ? Slope::rising : Slope::falling;
}

/// Narrows an interval with one root of known slope, by the quadratic relative to the interval's
/// middle. There -c / (b + sign(b) √D) is the root whose slope has the sign of b.
RootInterval narrowed(const From& from, const RootInterval& wide, Slope slope)
{
    const Quad middle = (wide.low + wide.high) / 2;
    if (!(magnitude(middle) < Quad(infinity)))
        return wide;
    const Quadratic f = from(middle);
    const Ball d = discriminant(f);
    if (!is_positive(d) || !(slope == Slope::rising ? is_positive(f.b) : is_negative(f.b)))
        return wide;
    const RootInterval narrow = around(middle, f.c / vieta_sum(f.b, square_root(d)));
    return {std::max(wide.low, narrow.low), std::min(wide.high, narrow.high), wide.certain, 1};
}

/// Narrows an interval until it is far below a double's last place, in at most four steps.
RootInterval refined(const From& from, RootInterval root, Slope slope)
{
    for (int step = 0; step < 4; ++step) {
        if (root.high - root.low <= Quad(0x1p-80) * magnitude(root.low))
            break;
        root = narrowed(from, root, slope);
    }
    return root;
}

std::vector<RootInterval> roots_of_line(const From& from, const Quadratic& f, Quad start)
{
    if (is_zero(f.b))
        return {};
    if (!has_sign(f.b))
        return {anywhere(1)};
    return {refined(from, around(start, -f.c / (f.b + f.b)), slope_of(f.b))};
}

/// The roots of a quadratic whose a has a sign.
std::vector<RootInterval> roots_of_parabola(const From& from, const Quadratic& first, Quad start)
{
    // Relative to the middle between the roots, where nothing of b² - a c cancels.
    const Quad middle = start + Quad(static_cast<double>((-first.b / first.a).mid));
    const Quadratic f = from(middle);
    const Ball d = discriminant(f);
    if (is_negative(d))
        return {};
    if (is_zero(d)) {
        RootInterval touch = around(middle, -f.b / f.a);
        touch.roots = 2;
        return {touch};
    }
    if (!is_positive(d)) {
        const Quad most = upper_end(d);
        if (!(most < Quad(infinity)))
            return {anywhere(2)};
        const double largest_root = size_of(packtrace::square_root(std::max(most, Quad(0))));
        RootInterval both = around(middle, Ball((-f.b).mid, f.b.radius + largest_root) / f.a);
        both.certain = false;
        both.roots = 2;
        return {both};
    }
    const Ball root = square_root(d);
    Ball falling = (-f.b - root) / f.a;
    Ball rising = (root - f.b) / f.a;
    if (has_sign(f.b)) {
        const Ball q = vieta_sum(f.b, root);
        (is_positive(f.b) ? rising : falling) = f.c / q;
    }
    return {refined(from, around(middle, falling), Slope::falling),
            refined(from, around(middle, rising), Slope::rising)};
}

/// The roots where a may be 0: one root, and another very far away on either side.
std::vector<RootInterval> roots_of_any(const From& from, const Quadratic& f, Quad start)
{
    const Ball d = discriminant(f);
    if (!has_sign(f.b) || !is_positive(d))
        return {anywhere(2)};
    const Ball q = vieta_sum(f.b, square_root(d));
    const RootInterval near = refined(from, around(start, f.c / q), slope_of(f.b));
    const double far = least_size(q) / largest_size(f.a);
    if (!(far < infinity) || !(magnitude(start) < Quad(far / 4)))
        return {near, anywhere(1)};
    return {near,
            {-Quad(infinity), -Quad(far / 2), false, 1},
            {Quad(far / 2), Quad(infinity), false, 1}};
}

}  // namespace

std::vector<RootInterval> roots_of(const From& from, Quad start)
{
    const Quadratic f = from(start);
    if (is_zero(f.a))
        return roots_of_line(from, f, start);
    return has_sign(f.a) ? roots_of_parabola(from, f, start) : roots_of_any(from, f, start);
}

}  // namespace packtrace::bounds
