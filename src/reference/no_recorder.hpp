#pragma once

#include "reference/surfaces/closest_intersection.hpp"

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

}  // namespace packtrace::reference
