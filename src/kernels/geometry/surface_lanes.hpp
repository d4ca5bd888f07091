#pragma once

#include "kernels/geometry/kinds.hpp"

// The surfaces that a packet's lanes have hit, one a lane, so that they are refined together.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The spheres among the surfaces of a packet's lanes: each lane's record is loaded by itself, as
/// hits of rays that run apart are hardly ever on the same.
class SphereLanes {
public:
    /// `surface` is a surface's number in the lanes of `active`, of which there are some.
    SphereLanes(const abi::ShapesView& shapes, const vint<float>& surface, std::uint32_t active)
    {
        alignas(64) lane_int<float> number[lanes<float>];
        store(number, surface);
        const vint<float> any(number[__builtin_ctz(active)]);
        store(number, select(from_bits<float>(active), surface, any));
        const vint<float> index = as_int(lane_by_lane<float>(
            [&](int lane) { return __builtin_bit_cast(float, shapes.index[number[lane]]); }));
        const auto word = [](std::uint32_t record, abi::SurfaceKind kind) {
            const abi::SurfaceIndex parts{record & abi::largest_record, kind, 0};
            return vint<float>(__builtin_bit_cast(lane_int<float>, parts));
        };
        const vint<float> kind = index & word(0, abi::SurfaceKind::polygon);
        on_spheres_ = active & bits(int_equal(kind, word(0, abi::SurfaceKind::sphere)));
        if (on_spheres_ == 0) {
            for (const abi::SphereShape*& sphere : sphere_)
                sphere = &unit_sphere;
            return;
        }
        const vint<float> record = index & word(abi::largest_record, abi::SurfaceKind::none);
        store(number, record);
        const vint<float> some(number[__builtin_ctz(on_spheres_)]);
        store(number, select(from_bits<float>(on_spheres_), record, some));
        for (int lane = 0; lane < lanes<float>; ++lane)
            sphere_[lane] = shapes.spheres + number[lane];
    }

    /// Lanes whose surfaces are spheres.
    [[nodiscard]] std::uint32_t on_spheres() const
    {
        return on_spheres_;
    }

    /// Lanes of other surfaces have some sphere.
    [[nodiscard]] SphereForm form() const
    {
        const auto field = [&](const auto& value) {
            return BothHalves<vreal<double>>{
                lane_by_lane<double>([&](int lane) { return value(*sphere_[lane]); }),
                lane_by_lane<double>([&](int lane) { return value(*sphere_[high_lane + lane]); })};
        };
        const auto [x, x_high] = field([](const abi::SphereShape& s) { return s.center[0]; });
        const auto [y, y_high] = field([](const abi::SphereShape& s) { return s.center[1]; });
        const auto [z, z_high] = field([](const abi::SphereShape& s) { return s.center[2]; });
        const auto [r, r_high] = field([](const abi::SphereShape& s) { return s.radius; });
        const BothHalves<Vec3v<double>> center = {{x, y, z}, {x_high, y_high, z_high}};
        return {center,
                {r * r, r_high * r_high},
                narrow(center.low, center.high),
                narrow(r, r_high)};
    }

private:
    /// Of one lane both halves are the same.
    static constexpr int high_lane = lanes<float> > 1 ? lanes<double> : 0;
    static constexpr abi::SphereShape unit_sphere = {{0, 0, 0}, 1};

    std::uint32_t on_spheres_;
    const abi::SphereShape* sphere_[lanes<float>];
};

template <class Value>
inline BothHalves<Value> select(const BothHalves<vmask<double>>& active, const BothHalves<Value>& a,
                                const BothHalves<Value>& b)
{
    return {select(active.low, a.low, b.low), select(active.high, a.high, b.high)};
}

inline vreal<float> narrow(const BothHalves<vreal<double>>& x)
{
    return narrow(x.low, x.high);
}
inline Vec3v<float> narrow(const BothHalves<Vec3v<double>>& v)
{
    return narrow(v.low, v.high);
}

/// A sphere, an anchored sphere or something flat a lane. Spheres are anchored at their centres,
/// with a gradient of nothing there, so that residuals have the bits of a packet on one of them.
struct RoundForm {
    static constexpr bool root_is_known = false;

    AnchoredForm anchored;
    SphereForm sphere;
    std::uint32_t on_spheres;

    explicit RoundForm(const SphereLanes& spheres)
        : sphere(spheres.form()), on_spheres(spheres.on_spheres())
    {
        // Added to what has no sign, too, this leaves it.
        const vreal<double> nothing(-0.0);
        const Vec3v<double> none{nothing, nothing, nothing};
        const vreal<double> one(1.0);
        anchored.base = sphere.base;
        anchored.normal = {none, none};
        anchored.curvature = {one, one};
        anchored.offset = {negated(sphere.radius2.low), negated(sphere.radius2.high)};
    }

    /// Another form in some lanes.
    void put(std::uint32_t lanes_of, const AnchoredForm& form)
    {
        const BothHalves<vmask<double>> active = {
            from_bits<double>(lanes_of & all_lanes<double>),
            from_bits<double>(lanes<float> > 1 ? lanes_of >> lanes<double> : lanes_of)};
        anchored.base = select(active, form.base, anchored.base);
        anchored.normal = select(active, form.normal, anchored.normal);
        anchored.curvature = select(active, form.curvature, anchored.curvature);
        anchored.offset = select(active, form.offset, anchored.offset);
    }

    /// Rounds what was put.
    void finish()
    {
        anchored.rough_base = narrow(anchored.base);
        anchored.rough_normal = narrow(anchored.normal);
        anchored.rough_curvature = narrow(anchored.curvature);
        anchored.rough_offset = narrow(anchored.offset);
    }
};

inline RoughRoot rough_root(const RoundForm& form, const RayPacket<float>& rays)
{
    RoughRoot root = rough_root(form.anchored, rays);
    if (form.on_spheres != 0)
        root.t = select(from_bits<float>(form.on_spheres), rough_root(form.sphere, rays).t, root.t);
    return root;
}

inline Residual residual(const RoundForm& form, const WideRays& rays, const vreal<float>& t)
{
    return residual(form.anchored, rays, t);
}

inline Vec3v<float> normal_of(const RoundForm& form, const Vec3v<float>& gradient,
                              const Vec3v<float>& step)
{
    return select(from_bits<float>(form.on_spheres), normal_of(form.sphere, gradient, step),
                  normal_of(form.anchored, gradient, step));
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
