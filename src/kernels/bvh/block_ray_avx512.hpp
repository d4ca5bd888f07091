#pragma once

#include <immintrin.h>

// BlockRay for floats on AVX-512, where a block holds half as many spheres as a packet has lanes:
// it uses registers of eight floats, which Zen 4 processes twice as fast. The operations are those
// of BlockRay and quadratic.hpp.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// Loads eight values and eight zeros.
inline vreal<float> load_of_block(const float (&block)[abi::node_width], int)
{
    return _mm512_zextps256_ps512(_mm256_load_ps(block));
}

template <>
class BlockRay<float> {
    static_assert(abi::node_width == 8);

public:
    BlockRay(const RayBundle<float>& bundle, int ray) : t_min_(_mm256_set1_ps(bundle.t_min[ray]))
    {
        for (int axis = 0; axis < 3; ++axis) {
            org_[axis] = _mm256_set1_ps(bundle.org[axis][ray]);
            dir_[axis] = _mm256_set1_ps(bundle.dir[axis][ray]);
        }
        dir2_ = dot(dir_, dir_);
    }

    std::uint32_t first_roots(const abi::SphereBlock<float>& block, float t_max,
                              float (&t)[abi::node_width]) const
    {
        const Quadratics8 q = quadratics(block);
        const std::uint32_t active = may_hit(q);
        if (active == 0)
            return 0;
        const __m256 minus_q = minus_q_of(q);
        __m256 root = lesser_root(q, minus_q, active);
        std::uint32_t beyond = _mm256_cmp_ps_mask(root, t_min_, _CMP_GT_OQ);
        const std::uint32_t leaving = _mm256_cmp_ps_mask(minus_q, _mm256_setzero_ps(), _CMP_LT_OQ);
        const auto retry = static_cast<__mmask8>(active & ~beyond & leaving);
        if (retry != 0) {
            root = _mm256_mask_div_ps(root, retry, negated(minus_q), dir2_);
            beyond = _mm256_cmp_ps_mask(root, t_min_, _CMP_GT_OQ);
        }
        const __m256 infinity = _mm256_set1_ps(__builtin_inff());
        _mm256_storeu_ps(t, root);
        return active & beyond & _mm256_cmp_ps_mask(root, infinity, _CMP_LT_OQ) &
               _mm256_cmp_ps_mask(root, _mm256_set1_ps(t_max), _CMP_LE_OQ);
    }

    std::uint32_t blocked_by(const abi::SphereBlock<float>& block, float t_end,
                             RayInterval interval) const
    {
        const Quadratics8 q = quadratics(block);
        const __m256 end = _mm256_set1_ps(t_end);
        return interval == RayInterval::closed ? root_between(q, end) : any_root(q, end);
    }

    std::uint32_t near(const abi::SphereBlock<float>& block, const RayBundle<float>& bundle,
                       int ray) const
    {
        __m256 o[3];
        for (int axis = 0; axis < 3; ++axis)
            o[axis] = _mm256_sub_ps(org_[axis], _mm256_load_ps(block.center[axis]));
        const __m256 moment[3] = {cross(o, 1, 2), cross(o, 2, 0), cross(o, 0, 1)};
        // leaf_outer() for eight lanes.
        const __m256 shift = _mm256_set1_ps(bundle.moment_error * (1.0f + roundoffs(12.0f)));
        const __m256 outer = _mm256_fmadd_ps(_mm256_load_ps(block.radius),
                                             _mm256_set1_ps(1.0f + roundoffs(12.0f)), shift);
        const __m256 limit = _mm256_mul_ps(signed_square(outer), dir2_);
        const auto beside =
            static_cast<__mmask8>(~_mm256_cmp_ps_mask(dot(moment, moment), limit, _CMP_GT_OQ));
        return beside == 0 ? 0 : beside & ~before_or_behind(o, outer, bundle, ray);
    }

private:
    std::uint32_t before_or_behind(const __m256 (&w)[3], __m256 outer,
                                   const RayBundle<float>& bundle, int ray) const
    {
        const __m256 length = _mm256_mul_ps(dir2_, _mm256_set1_ps(bundle.inverse[ray]));
        const __m256 reach = _mm256_mul_ps(outer, length);
        const __m256 b = dot(w, dir_);
        const __m256 size = _mm256_add_ps(_mm256_andnot_ps(_mm256_set1_ps(-0.0f), b), reach);
        const __m256 slack =
            _mm256_fmadd_ps(_mm256_set1_ps(roundoffs(60.0f)), size,
                            _mm256_mul_ps(_mm256_set1_ps(bundle.center_error), length));
        const std::uint32_t leaves =
            _mm256_cmp_ps_mask(b, slack, _CMP_GT_OQ) &
            _mm256_cmp_ps_mask(dot(w, w), _mm256_mul_ps(outer, outer), _CMP_GT_OQ);
        const __m256 last = _mm256_fmadd_ps(dir2_, _mm256_set1_ps(bundle.t[ray]), b);
        return leaves | _mm256_cmp_ps_mask(negated(last), _mm256_add_ps(reach, slack), _CMP_GT_OQ);
    }

    static __m256 signed_square(__m256 x)
    {
        return _mm256_mul_ps(x, _mm256_andnot_ps(_mm256_set1_ps(-0.0f), x));
    }
    struct Quadratics8 {
        __m256 b, c, discriminant;
    };

    static __m256 dot(const __m256 (&a)[3], const __m256 (&b)[3])
    {
        return _mm256_fmadd_ps(a[0], b[0], _mm256_fmadd_ps(a[1], b[1], _mm256_mul_ps(a[2], b[2])));
    }
    static __m256 negated(__m256 x)
    {
        return _mm256_xor_ps(x, _mm256_set1_ps(-0.0f));
    }

    Quadratics8 quadratics(const abi::SphereBlock<float>& block) const
    {
        __m256 o[3];
        for (int axis = 0; axis < 3; ++axis)
            o[axis] = _mm256_sub_ps(org_[axis], _mm256_load_ps(block.center[axis]));
        const __m256 radius2 = signed_square(_mm256_load_ps(block.radius));
        const __m256 moment[3] = {cross(o, 1, 2), cross(o, 2, 0), cross(o, 0, 1)};
        return {dot(o, dir_), _mm256_sub_ps(dot(o, o), radius2),
                _mm256_fmsub_ps(dir2_, radius2, dot(moment, moment))};
    }
    /// One component of o × d.
    __m256 cross(const __m256 (&o)[3], int i, int j) const
    {
        return _mm256_fmsub_ps(o[i], dir_[j], _mm256_mul_ps(o[j], dir_[i]));
    }

    static std::uint32_t may_hit(const Quadratics8& q)
    {
        const __m256 zero = _mm256_setzero_ps();
        return _mm256_cmp_ps_mask(q.discriminant, zero, _CMP_GE_OQ) &
               (_mm256_cmp_ps_mask(q.b, zero, _CMP_LT_OQ) |
                _mm256_cmp_ps_mask(q.c, zero, _CMP_LT_OQ));
    }
    static __m256 signed_root_of(const Quadratics8& q)
    {
        const __m256 sign = _mm256_and_ps(q.b, _mm256_set1_ps(-0.0f));
        return _mm256_or_ps(_mm256_sqrt_ps(q.discriminant), sign);
    }
    static __m256 minus_q_of(const Quadratics8& q)
    {
        return _mm256_add_ps(q.b, signed_root_of(q));
    }

    __m256 lesser_root(const Quadratics8& q, __m256 minus_q, std::uint32_t crosses) const
    {
        const __m256 root = _mm256_div_ps(negated(q.c), minus_q);
        const __m256 square = _mm256_mul_ps(minus_q, minus_q);
        const __m256 product = _mm256_mul_ps(dir2_, q.c);
        const __m256 size = _mm256_andnot_ps(_mm256_set1_ps(-0.0f), product);
        const __mmask8 near = _mm256_cmp_ps_mask(
            size, _mm256_mul_ps(_mm256_set1_ps(near_square<float>), square), _CMP_GT_OQ);
        if ((near & crosses) == 0)
            return root;
        const __m256 zero = _mm256_setzero_ps();
        const __mmask8 twins = near & _mm256_cmp_ps_mask(q.b, zero, _CMP_LT_OQ) &
                               _mm256_cmp_ps_mask(product, zero, _CMP_GT_OQ);
        const __m256 first =
            _mm256_mask_min_ps(root, twins, root, _mm256_div_ps(negated(minus_q), dir2_));
        return _mm256_mask_div_ps(first, _mm256_cmp_ps_mask(size, square, _CMP_GT_OQ),
                                  _mm256_sub_ps(signed_root_of(q), q.b), dir2_);
    }

    std::uint32_t any_root(const Quadratics8& q, __m256 t_end) const
    {
        const std::uint32_t active = may_hit(q);
        if (active == 0)
            return 0;
        const __m256 minus_q = minus_q_of(q);
        const auto between = [&](__m256 t) -> std::uint32_t {
            return _mm256_cmp_ps_mask(t, t_min_, _CMP_GT_OQ) &
                   _mm256_cmp_ps_mask(t, t_end, _CMP_LT_OQ);
        };
        return active & (between(lesser_root(q, minus_q, active)) |
                         between(_mm256_div_ps(negated(minus_q), dir2_)));
    }

    std::uint32_t root_between(const Quadratics8& q, __m256 t_end) const
    {
        const __m256 zero = _mm256_setzero_ps();
        const auto below = [&](__m256 x) -> std::uint32_t {
            return _mm256_cmp_ps_mask(x, zero, _CMP_LT_OQ);
        };
        const auto not_below = [&](__m256 x) -> std::uint32_t {
            return _mm256_cmp_ps_mask(x, zero, _CMP_GE_OQ);
        };
        const __m256 slope_near = _mm256_fmadd_ps(dir2_, t_min_, q.b);
        const __m256 slope_far = _mm256_fmadd_ps(dir2_, t_end, q.b);
        const __m256 near = _mm256_fmadd_ps(_mm256_add_ps(slope_near, q.b), t_min_, q.c);
        const __m256 far = _mm256_fmadd_ps(_mm256_add_ps(slope_far, q.b), t_end, q.c);
        const std::uint32_t dips = not_below(near) & not_below(far) & not_below(q.discriminant) &
                                   below(slope_near) &
                                   _mm256_cmp_ps_mask(slope_far, zero, _CMP_GT_OQ);
        std::uint32_t leaves = not_below(near) & below(far);
        if (leaves != 0)
            leaves &= ends_inside(q, t_end, slope_far);
        return (below(near) & not_below(far)) | leaves | dips;
    }

    /// The operations are those of ends_inside() in quadratic.hpp.
    std::uint32_t ends_inside(const Quadratics8& q, __m256 t_end, __m256 slope) const
    {
        const auto size_of = [](__m256 x) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), x); };
        const __m256 slope2 = _mm256_mul_ps(slope, slope);
        const __m256 way = _mm256_mul_ps(dir2_, t_end);
        const __m256 lost = _mm256_fmadd_ps(_mm256_add_ps(way, way), size_of(slope), slope2);
        const __m256 lost_by_sum = _mm256_fmadd_ps(way, way, _mm256_mul_ps(dir2_, size_of(q.c)));
        const std::uint32_t better =
            _mm256_cmp_ps_mask(_mm256_mul_ps(_mm256_set1_ps(16.0f), lost), lost_by_sum, _CMP_LT_OQ);
        return _mm256_cmp_ps_mask(slope2, q.discriminant, _CMP_LT_OQ) | (~better & 0xffu);
    }

    __m256 org_[3];
    __m256 dir_[3];
    __m256 dir2_;
    __m256 t_min_;
};

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
