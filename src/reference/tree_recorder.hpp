#pragma once

#include <packtrace/explain.hpp>
#include "reference/surfaces/closest_intersection.hpp"
#include "reference/surfaces/surface_normal.hpp"

#include <vector>

namespace packtrace::reference {

/// Keeps what NoRecorder describes as a tree of rays. Copies share the tree, so that a note of
/// const methods can hold one.
class TreeRecorder {
public:
    /// The tree as far as it has grown, and the way from its root to the ray being traced.
    struct Growth {
        RayNode root;
        std::vector<RayNode*> open;
        RayKind next = RayKind::camera;
        Rgb factor{1.0};  ///< of the next child
    };

    class Traced {
    public:
        explicit Traced(Growth& growth) : growth_(growth)
        {
        }
        ~Traced()
        {
            growth_.open.pop_back();
        }
        Traced(const Traced&) = delete;
        Traced& operator=(const Traced&) = delete;

    private:
        Growth& growth_;
    };

    /// `growth` must outlive all copies.
    explicit TreeRecorder(Growth& growth) : growth_(&growth)
    {
    }

    template <class Real>
    [[nodiscard]] Traced ray(const Vec3<Real>& org, const Vec3<Real>& dir) const
    {
        return begin_ray(rgb(org), rgb(dir));
    }
    template <class Real>
    void hit(Real t, int object, const Vec3<Real>& P, const Vec3<Real>& N) const
    {
        now().t = static_cast<double>(t);
        now().object = object;
        now().point = rgb(P);
        now().normal = rgb(N);
    }
    template <class Real>
    void outward_hit(const Bodies<Real>& bodies, const Hit<Real>& at, const Vec3<Real>& P,
                     const Vec3<Real>& D) const
    {
        hit(at.t, at.object, P, facing(bodies, at, P, D).outward);
    }
    template <class Real>
    [[nodiscard]] Color<Real> miss(const Color<Real>& color) const
    {
        now().brought = rgb(color);
        return color;
    }
    template <class Real>
    [[nodiscard]] Color<Real> share(int light, const Color<Real>& share) const
    {
        now().lights.push_back({light, rgb(share), Rgb(0.0)});
        return share;
    }
    [[nodiscard]] bool blocked(int light, bool blocked) const
    {
        now().lights.push_back({light, Rgb(blocked ? 0.0 : 1.0), Rgb(0.0)});
        return blocked;
    }
    template <class Real>
    [[nodiscard]] Color<Real> adds(const Color<Real>& color) const
    {
        now().lights.back().color += rgb(color);
        return color;
    }
    template <class Real>
    void tint(const Color<Real>& color) const
    {
        for (LightShare& light : now().lights)
            light.color *= rgb(color);
    }
    template <class Real>
    [[nodiscard]] Color<Real> local(const Color<Real>& color) const
    {
        now().local = rgb(color);
        return color;
    }
    template <class Real>
    void mirrored(const Color<Real>& factor) const
    {
        growth_->next = RayKind::mirrored;
        growth_->factor = rgb(factor);
    }
    template <class Real>
    void refracted(const Color<Real>& factor) const
    {
        growth_->next = RayKind::refracted;
        growth_->factor = rgb(factor);
    }
    template <class Real>
    [[nodiscard]] Color<Real> limit(const Color<Real>& color) const
    {
        now().brought += growth_->factor * rgb(color);
        return color;
    }

private:
    template <class Real>
    [[nodiscard]] static Rgb rgb(const Vec3<Real>& v)
    {
        return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
    }
    [[nodiscard]] Traced begin_ray(const Rgb& org, const Rgb& dir) const;
    [[nodiscard]] RayNode& now() const
    {
        return *growth_->open.back();
    }

    Growth* growth_;
};

}  // namespace packtrace::reference
