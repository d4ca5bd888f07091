#include "reference/tree_recorder.hpp"

#include "reference/surface_normal.hpp"

namespace packtrace::reference {
namespace {

Rgb rgb(const Vec3<double>& v)
{
    return {v.x, v.y, v.z};
}

}  // namespace

// A child may be added while only its ancestors are open, none of which moves.
TreeRecorder::Traced TreeRecorder::ray(const Vec3<double>& org, const Vec3<double>& dir) const
{
    RayNode* node = &growth_->root;
    if (!growth_->open.empty()) {
        const Rgb weight = now().weight * growth_->factor;
        node = &now().children.emplace_back();
        node->weight = weight;
        node->kind = growth_->next;
    }
    node->org = rgb(org);
    node->dir = rgb(dir);
    growth_->open.push_back(node);
    return Traced(*growth_);
}

void TreeRecorder::hit(double t, int object, const Vec3<double>& P, const Vec3<double>& N) const
{
    now().t = t;
    now().object = object;
    now().point = rgb(P);
    now().normal = rgb(N);
}

void TreeRecorder::outward_hit(const Bodies<double>& bodies, const Hit<double>& at,
                               const Vec3<double>& P) const
{
    hit(at.t, at.object, P, outward_normal(bodies, at, P));
}

Color<double> TreeRecorder::miss(const Color<double>& color) const
{
    now().brought = rgb(color);
    return color;
}

Color<double> TreeRecorder::share(int light, const Color<double>& share) const
{
    now().lights.push_back({light, rgb(share), Rgb(0.0)});
    return share;
}

bool TreeRecorder::blocked(int light, bool blocked) const
{
    now().lights.push_back({light, Rgb(blocked ? 0.0 : 1.0), Rgb(0.0)});
    return blocked;
}

Color<double> TreeRecorder::adds(const Color<double>& color) const
{
    now().lights.back().color += rgb(color);
    return color;
}

void TreeRecorder::tint(const Color<double>& color) const
{
    for (LightShare& light : now().lights)
        light.color *= rgb(color);
}

Color<double> TreeRecorder::local(const Color<double>& color) const
{
    now().local = rgb(color);
    return color;
}

void TreeRecorder::mirrored(const Color<double>& factor) const
{
    growth_->next = RayKind::mirrored;
    growth_->factor = rgb(factor);
}

void TreeRecorder::refracted(const Color<double>& factor) const
{
    growth_->next = RayKind::refracted;
    growth_->factor = rgb(factor);
}

Color<double> TreeRecorder::limit(const Color<double>& color) const
{
    now().brought += growth_->factor * rgb(color);
    return color;
}

}  // namespace packtrace::reference
