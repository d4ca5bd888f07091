#pragma once

#include "kernels/bvh/bvh_crossings.hpp"
#include "kernels/lists/closest.hpp"
#include "kernels/stream/ray_chunks.hpp"

// All hits of rays from the caller.
namespace packtrace::PACKTRACE_ISA {
namespace {

/// The precision in which all hits are searched for: with Features::exact double, as every single
/// hit matters.
template <abi::Features F, class Real>
using SearchReal = std::conditional_t<F.exact, double, Real>;

template <abi::Features F, class Real>
inline const abi::GeometryView<SearchReal<F, Real>>& searched(const abi::SceneView<Real>& scene)
{
    if constexpr (F.exact)
        return *scene.wide;
    else
        return scene;
}

/// Fills a bundle with the rays of a stream from `begin` on.
template <class Search, class Real>
inline void gather_all(const abi::RaysView<Real>& view, int begin, RayBundle<Search>& bundle)
{
    const int count = view.count - begin < bundle_rays ? view.count - begin : bundle_rays;
    for (std::uint16_t& cell : bundle.active)
        cell = 0;
    for (int ray = 0; ray < count; ++ray) {
        bool number = true;
        for (int axis = 0; axis < 3; ++axis) {
            bundle.org[axis][ray] = view.org[axis][begin + ray];
            bundle.dir[axis][ray] = view.dir[axis][begin + ray];
            number = number && bundle.org[axis][ray] == bundle.org[axis][ray] &&
                     bundle.dir[axis][ray] == bundle.dir[axis][ray];
        }
        bundle.t_min[ray] = view.t_min[begin + ray];
        bundle.t[ray] = view.t_max[begin + ray];
        number = number && bundle.t_min[ray] == bundle.t_min[ray] && bundle.t[ray] == bundle.t[ray];
        bundle.surface[ray] = bundle.own[ray] = -1;
        if (number)
            bundle.active[ray / cell_rays] |= static_cast<std::uint16_t>(1u << ray % cell_rays);
        else
            bundle.t[ray] = static_cast<Search>(-__builtin_inf());
    }
    end_bundle(bundle, count);
}

/// Passes the hits of one surface to the sink.
template <class Search, class Real>
[[gnu::noinline]] void report_hits(const abi::SceneView<Real>& scene,
                                   const RayBundle<Search>& bundle, int begin, int first,
                                   const abi::HitSink<Real>& sink, std::uint32_t valid,
                                   const vreal<Search>& t, std::int32_t surface)
{
    const RayPacket<Search> rays = load_rays(bundle, first);
    std::uint32_t active =
        valid & bits((t > rays.t_min) & (t < load(bundle.t + first))) & active_lanes(bundle, first);
    if (active == 0)
        return;
    const Vec3v<Search> normal = surface_normal<Search>(
        scene.shapes, scene.shapes.index[surface], madd<Search>(t, rays.dir, rays.org), rays.dir);
    alignas(64) Search ts[lanes<Search>];
    alignas(64) Search normals[3][lanes<Search>];
    store(ts, t);
    store(normals[0], normal.x);
    store(normals[1], normal.y);
    store(normals[2], normal.z);
    const std::int32_t object = scene.materials.of_surface[surface].object;
    for (; active != 0; active &= active - 1) {
        const int lane = __builtin_ctz(active);
        const Real unit_normal[3] = {static_cast<Real>(normals[0][lane]),
                                     static_cast<Real>(normals[1][lane]),
                                     static_cast<Real>(normals[2][lane])};
        sink.take(sink.context, begin + first + lane, static_cast<double>(ts[lane]), object,
                  unit_normal);
    }
}

template <abi::Features F, class Real>
inline void all_hits(const abi::SceneView<Real>& scene, const abi::RaysView<Real>& view,
                     const abi::HitSink<Real>& sink)
{
    using Search = SearchReal<F, Real>;
    constexpr abi::Features search = abi::with_exact(F, false);
    const abi::GeometryView<Search>& geometry = searched<F>(scene);
    RayBundle<Search> bundle;
    for (int begin = 0; begin < view.count; begin += bundle_rays) {
        gather_all(view, begin, bundle);
        const auto report = [&](int first, std::uint32_t valid, const vreal<Search>& t,
                                std::int32_t surface) {
            report_hits(scene, bundle, begin, first, sink, valid, t, surface);
        };
        for (int first = 0; first < bundle_rays; first += lanes<Search>)
            if (active_lanes(bundle, first) != 0)
                visit_all_crossings<search>(
                    geometry, load_rays(bundle, first),
                    [&](vmask<Search> valid, const vreal<Search>& t, std::int32_t surface) {
                        report(first, bits(valid), t, surface);
                    });
        if (!geometry.tree.empty())
            visit_crossings_in_bvh<abi::tree_features(search)>(geometry.tree, bundle,
                                                               CrossingVisitor<Search>(report));
    }
}

}  // namespace
}  // namespace packtrace::PACKTRACE_ISA
