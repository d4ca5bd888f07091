#pragma once

#include "reference/surfaces/hits.hpp"
#include <packtrace/explain.hpp>

#include <vector>

// Recorders receive the events of tracing: NoRecorder ignores them, TreeRecorder builds a ray tree.
namespace packtrace::reference {

/// The interface of a recorder. The models call it while they trace. This one, the default, does
/// nothing and compiles to nothing.
struct NoRecorder {
    /// Ends its ray when it goes out of scope.
    struct Traced {
        ~Traced()
        {
        }
    };

    /// Begins a ray: a camera ray, or the child announced last. Later calls are about this ray
    /// until it ends.
    template <class Real>
    [[nodiscard]] Traced ray(const Vec3<Real>&, const Vec3<Real>&) const
    {
        return {};
    }
    /// The ray's closest hit: t, object, point and shading normal.
    template <class Real>
    void hit(Real, int, const Vec3<Real>&, const Vec3<Real>&) const
    {
    }
    /// The closest hit of a model without a shading normal in world space: the outward normal is
    /// recorded. The last argument is the ray's direction.
    template <class Real>
    void outward_hit(const Bodies<Real>&, const Hit<Real>&, const Vec3<Real>&,
                     const Vec3<Real>&) const
    {
    }
    /// The colour of a ray that hits nothing.
    template <class Real>
    [[nodiscard]] Color<Real> miss(const Color<Real>& color) const
    {
        return color;
    }
    /// The share of light number `light` that reaches the hit. Later calls of adds() are about this
    /// light.
    template <class Real>
    [[nodiscard]] Color<Real> share(int, const Color<Real>& share) const
    {
        return share;
    }
    /// The same for a light that is occluded or not.
    [[nodiscard]] bool occluded(int, bool occluded) const
    {
        return occluded;
    }
    /// A colour that the light adds to the local light.
    template <class Real>
    [[nodiscard]] Color<Real> adds(const Color<Real>& color) const
    {
        return color;
    }
    /// The object's colour, in a model that multiplies the sum of all lights by it.
    template <class Real>
    void tint(const Color<Real>&) const
    {
    }
    /// The local light of the hit.
    template <class Real>
    [[nodiscard]] Color<Real> local(const Color<Real>& color) const
    {
        return color;
    }
    /// Announces a child ray, whose colour is multiplied by the argument.
    template <class Real>
    void mirrored(const Color<Real>&) const
    {
    }
    template <class Real>
    void refracted(const Color<Real>&) const
    {
    }
    /// The colour of the announced child, which the depth limit keeps from being traced.
    template <class Real>
    [[nodiscard]] Color<Real> limit(const Color<Real>& color) const
    {
        return color;
    }
};

/// Builds a tree of rays. Copies share the tree, so that a model's const methods can record.
class TreeRecorder {
public:
    /// The tree so far, and the path from its root to the ray being traced.
    struct Growth {
        RayNode root;
        std::vector<RayNode*> open;  ///< the path
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
    [[nodiscard]] bool occluded(int light, bool occluded) const
    {
        now().lights.push_back({light, Rgb(occluded ? 0.0 : 1.0), Rgb(0.0)});
        return occluded;
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
    // Only the ancestors of a new child are open, and adding the child moves none of them.
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
