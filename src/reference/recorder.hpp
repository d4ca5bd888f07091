#pragma once

#include "reference/surfaces/hits.hpp"
#include <packtrace/explain.hpp>

#include <vector>

// Recorders: what the notes tell of the rays they trace, to nobody or into a tree.
namespace packtrace::reference {

/// The notes tell a recorder what they do, as they do it. This one, the usual, hears nothing, and
/// nothing of it is left when compiled; TreeRecorder keeps the tree of rays.
struct NoRecorder {
    /// Ends a ray where it goes out of scope.
    struct Traced {
        ~Traced()
        {
        }
    };

    /// A ray from here on, all that is told being about it until it ends: a camera ray, or the
    /// child announced last.
    template <class Real>
    [[nodiscard]] Traced ray(const Vec3<Real>&, const Vec3<Real>&) const
    {
        return {};
    }
    /// The ray's closest hit: t, object, point and the normal that is shaded.
    template <class Real>
    void hit(Real, int, const Vec3<Real>&, const Vec3<Real>&) const
    {
    }
    /// The same in a note that has no such normal: the outward one in world space; the
    /// last argument is the ray's direction.
    template <class Real>
    void outward_hit(const Bodies<Real>&, const Hit<Real>&, const Vec3<Real>&,
                     const Vec3<Real>&) const
    {
    }
    /// What the ray sees as it hits nothing.
    template <class Real>
    [[nodiscard]] Color<Real> miss(const Color<Real>& color) const
    {
        return color;
    }
    /// The share of light number `light` that reaches the hit; `adds` is told of this light.
    template <class Real>
    [[nodiscard]] Color<Real> share(int, const Color<Real>& share) const
    {
        return share;
    }
    /// The same where a light is blocked or not.
    [[nodiscard]] bool blocked(int, bool blocked) const
    {
        return blocked;
    }
    /// One of the colours the light adds to the local light.
    template <class Real>
    [[nodiscard]] Color<Real> adds(const Color<Real>& color) const
    {
        return color;
    }
    /// What the object's colour leaves of all lights, in a note that multiplies by it last.
    template <class Real>
    void tint(const Color<Real>&) const
    {
    }
    /// What the hit itself sends back along the ray.
    template <class Real>
    [[nodiscard]] Color<Real> local(const Color<Real>& color) const
    {
        return color;
    }
    /// A child is next, its colour to be multiplied by `factor`.
    template <class Real>
    void mirrored(const Color<Real>&) const
    {
    }
    template <class Real>
    void refracted(const Color<Real>&) const
    {
    }
    /// What the child brings that the depth limit keeps from being traced.
    template <class Real>
    [[nodiscard]] Color<Real> limit(const Color<Real>& color) const
    {
        return color;
    }
};

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
    // A child may be added while only its ancestors are open, none of which moves.
    [[nodiscard]] Traced begin_ray(const Rgb& org, const Rgb& dir) const
    {
        RayNode* node = &growth_->root;
        if (!growth_->open.empty()) {
            const Rgb weight = now().weight * growth_->factor;
            node = &now().children.emplace_back();
            node->weight = weight;
            node->kind = growth_->next;
        }
        node->org = org;
        node->dir = dir;
        growth_->open.push_back(node);
        return Traced(*growth_);
    }
    [[nodiscard]] RayNode& now() const
    {
        return *growth_->open.back();
    }

    Growth* growth_;
};

}  // namespace packtrace::reference
