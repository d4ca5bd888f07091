#pragma once

#include <packtrace/explain.hpp>
#include "reference/closest_intersection.hpp"

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

    [[nodiscard]] Traced ray(const Vec3<double>& org, const Vec3<double>& dir) const;
    void hit(double t, int object, const Vec3<double>& P, const Vec3<double>& N) const;
    void outward_hit(const Bodies<double>& bodies, const Hit<double>& hit,
                     const Vec3<double>& P) const;
    [[nodiscard]] Color<double> miss(const Color<double>& color) const;
    [[nodiscard]] Color<double> share(int light, const Color<double>& share) const;
    [[nodiscard]] bool blocked(int light, bool blocked) const;
    [[nodiscard]] Color<double> adds(const Color<double>& color) const;
    void tint(const Color<double>& color) const;
    [[nodiscard]] Color<double> local(const Color<double>& color) const;
    void mirrored(const Color<double>& factor) const;
    void refracted(const Color<double>& factor) const;
    [[nodiscard]] Color<double> limit(const Color<double>& color) const;

private:
    [[nodiscard]] RayNode& now() const
    {
        return *growth_->open.back();
    }

    Growth* growth_;
};

}  // namespace packtrace::reference
