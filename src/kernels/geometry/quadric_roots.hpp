#pragma once

#include "kernels/geometry/quadric.hpp"
#include "kernels/geometry/quadric_bounds.hpp"

// Where rays hit the side of a quadric, in single precision, as intervals with error bounds.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The unclipped side along the rays, a t² + 2 b t + c = 0, and its discriminant.
struct QuadricLine {
    Vec3v<float> p;
    Vec3v<float> v;
    vreal<float> height;
    vreal<float> a;
    vreal<float> discriminant;
    vreal<float> discriminant_error;
};

template <Origin O>
inline QuadricLine line_of(const QuadricFilter& filter, const RayPacket<float>& rays)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    QuadricLine line;
    if constexpr (O == Origin::shared) {
        line.p = broadcast(filter.p);
        line.height = vreal<float>(filter.height);
    } else {
        const QuadricOrigin<float> origin = quadric_origin<float>(quadric, rays.org);
        line.p = origin.p;
        line.height = origin.height;
    }
    line.v = apply_inverse(quadric, rays.dir);
    line.a = dot(broadcast(quadric.square) * line.v, line.v);
    line.discriminant = quadric_discriminant<float>(quadric, cross(line.p, line.v), line.v, line.a);
    line.discriminant_error = vreal<float>(filter.discriminant_error) * rays.dir2;
    return line;
}

/// Lanes that certainly miss the surface: they do not hit the unclipped side and, if there are
/// caps, are outside of it everywhere.
inline std::uint32_t surely_misses(const QuadricFilter& filter, const QuadricLine& line,
                                   const RayPacket<float>& rays)
{
    const vreal<float> error = line.discriminant_error;
    const auto misses =
        (line.discriminant < negated(error)) & (error > vreal<float>(smallest_error));
    if (!filter.record->capped)
        return bits(misses);
    return bits(misses & (line.a > vreal<float>(filter.bend_error) * rays.dir2));
}

/// The roots in the lanes of `bent`, whose a is certainly not 0. The first root is in [low, low +
/// width], the second in [high - width, high]; in lanes not in `crosses` there may be none. In the
/// lanes of `convex`, whose a is above 0, rays are inside the unclipped side between the roots and
/// nowhere else.
struct SideRoots {
    vreal<float> low, high;
    vreal<float> width;
    std::uint32_t bent;
    std::uint32_t convex;
    std::uint32_t crosses;
};

inline SideRoots side_roots(const QuadricFilter& filter, const QuadricLine& line,
                            const RayPacket<float>& rays, const RayScale& scale)
{
    const abi::QuadricRecord<float>& quadric = *filter.record;
    const vreal<float> smallest(smallest_error);
    const vreal<float> error = line.discriminant_error;
    const vreal<float> bend_error = vreal<float>(filter.bend_error) * rays.dir2;
    const vreal<float> bend = abs(line.a);
    SideRoots roots;
    roots.bent = bits((bend > vreal<float>(4.0f) * bend_error) & (bend > smallest) &
                      (line.discriminant >= negated(error)) & (error > smallest));
    if (roots.bent == 0)
        return roots;
    roots.convex = roots.bent & bits(line.a > vreal<float>(0.0f));
    const vreal<float> b = madd(vreal<float>(quadric.linear), line.v.z,
                                dot(broadcast(quadric.square) * line.p, line.v));
    const vreal<float> inverse = vreal<float>(1.0f) / bend;
    const vreal<float> most = line.discriminant + error;
    const vreal<float> inverse_root = rough_inverse_sqrt(max(most, smallest));
    const vreal<float> root = most * inverse_root;
    const vreal<float> share =
        madd(vreal<float>(1.34f) * bend_error, inverse, vreal<float>(roundoffs(24.0f)));
    const vreal<float> slack =
        madd(abs(b) + root, share, vreal<float>(1.34f * filter.slope_error) * scale.length);
    const vreal<float> middle = negated(with_sign_of(inverse, line.a)) * b;
    const vreal<float> half = (root + slack) * inverse;
    roots.low = middle - half;
    roots.high = middle + half;
    roots.width = vreal<float>(2.02f) * (madd(error, inverse_root, slack) * inverse);
    // rough_root() later identifies the root by t, so the roots must be far enough apart.
    roots.crosses =
        roots.bent & bits((line.discriminant > error) & (vreal<float>(8.0f) * roots.width < half));
    return roots;
}

/// Heights along the rays, and their error without the error of the origin's height.
struct ClipHeights {
    vreal<float> origin;
    vreal<float> climb;
    vreal<float> error;

    ClipHeights(const QuadricFilter& filter, const QuadricLine& line, const RayPacket<float>& rays,
                const RayScale& scale)
        : origin(line.height),
          climb(dot(broadcast(filter.record->clip), rays.dir)),
          error(vreal<float>(filter.climb_error) * scale.length)
    {
    }
    vreal<float> at(const vreal<float>& t) const
    {
        return madd(t, climb, origin);
    }
};

/// Lanes whose roots, and the rays between them, lie outside [t_min, t_end] or outside the clipping
/// planes.
inline std::uint32_t surely_passes(const QuadricFilter& filter, const SideRoots& roots,
                                   const ClipHeights& heights, const vreal<float>& t_min,
                                   const vreal<float>& t_end)
{
    const vreal<float> from = max(roots.low, t_min);
    const vreal<float> to = min(roots.high, t_end);
    const std::uint32_t nowhere = bits(from > to);
    if (!filter.record->clipped)
        return nowhere;
    const vreal<float> first = heights.at(from);
    const vreal<float> last = heights.at(to);
    const vreal<float> first_error = abs(from) * heights.error;
    const vreal<float> last_error = abs(to) * heights.error;
    const vreal<float> low(filter.outer_low);
    const vreal<float> high(filter.outer_high);
    return nowhere | bits((first + first_error < low) & (last + last_error < low)) |
           bits((first - first_error > high) & (last - last_error > high));
}

/// A root in [low, high].
struct SideRoot {
    vreal<float> low, high;
    /// Lanes in which it is certainly between t_min and t_end and between the planes.
    std::uint32_t counts;
    std::uint32_t gone;  ///< lanes in which it certainly is not
};

inline SideRoot side_root(const QuadricFilter& filter, const ClipHeights& heights,
                          const vreal<float>& low, const vreal<float>& high,
                          const vreal<float>& t_min, const vreal<float>& t_end)
{
    SideRoot root{low, high, bits((low > t_min) & (high < t_end)),
                  bits(high < t_min) | bits(low > t_end)};
    if (!filter.record->clipped)
        return root;
    const vreal<float> first = heights.at(low);
    const vreal<float> last = heights.at(high);
    const vreal<float> error = max(abs(low), abs(high)) * heights.error;
    const vreal<float> lowest = min(first, last) - error;
    const vreal<float> highest = max(first, last) + error;
    root.counts &= bits((lowest > vreal<float>(filter.inner_low)) &
                        (highest < vreal<float>(filter.inner_high)));
    root.gone |= bits(highest < vreal<float>(filter.outer_low)) |
                 bits(lowest > vreal<float>(filter.outer_high));
    return root;
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
