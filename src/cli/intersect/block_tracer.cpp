#include "cli/intersect/block_tracer.hpp"

#include <cstddef>

namespace packtrace::cli {

template <class Real>
BlockTracer<Real>::BlockTracer(const Scene& scene, const RenderOptions& options, RayQuery query,
                               RayBounds bounds)
    : scene_(scene, options), rows_(scene), query_(query), bounds_(bounds)
{
}

std::string_view header_of(RayQuery query, RayBounds bounds)
{
    const bool bounded = bounds == RayBounds::proven;
    switch (query) {
        case RayQuery::all:
            return bounded ? HitRows::bounded_all_header : HitRows::all_header;
        case RayQuery::any:
            return HitRows::any_header;
        case RayQuery::closest:
            break;
    }
    return bounded ? HitRows::bounded_closest_header : HitRows::closest_header;
}

template <class Real>
std::string BlockTracer<Real>::rows_of(const RayBlock& block)
{
    Scratch& scratch = scratch_.local();
    read_rays(block.format, block.text, block.first_line, scratch.rays);
    std::string rows;
    switch (query_) {
        case RayQuery::closest:
            append_closest(rows, scratch);
            break;
        case RayQuery::all:
            append_all(rows, block.first_ray, scratch);
            break;
        case RayQuery::any:
            append_any(rows, scratch);
            break;
    }
    return rows;
}

template <class Real>
void BlockTracer<Real>::append_closest(std::string& rows, Scratch& s) const
{
    const RaysView<Real> rays = s.rays.view();
    for (auto* column : {&s.t, &s.normal_x, &s.normal_y, &s.normal_z})
        column->resize(rays.count);
    s.object.resize(rays.count);
    scene_.closest_hits(rays, {s.t.data(), s.object.data(), s.normal_x.data(), s.normal_y.data(),
                               s.normal_z.data()});
    const bool bounded = bounds_ == RayBounds::proven;
    s.bounds.resize(bounded ? rays.count : 0);
    if (bounded)
        scene_.bound_closest_hits(rays, s.object.data(), s.bounds.data());
    for (std::size_t i = 0; i < rays.count; ++i) {
        SurfaceHit<Real> hit{s.t[i], s.object[i], {}};
        hit.normal[0] = s.normal_x[i];
        hit.normal[1] = s.normal_y[i];
        hit.normal[2] = s.normal_z[i];
        if (bounded)
            rows_.append_closest(rows, hit, s.bounds[i]);
        else
            rows_.append_closest(rows, hit);
    }
}

template <class Real>
void BlockTracer<Real>::append_all(std::string& rows, std::uint64_t first_ray, Scratch& s) const
{
    const RaysView<Real> rays = s.rays.view();
    scene_.all_hits(rays, [&](std::size_t ray, std::span<const SurfaceHit<Real>> hits) {
        if (bounds_ == RayBounds::none)
            return rows_.append_all(rows, first_ray + ray, hits);
        s.bounds.resize(hits.size());
        scene_.bound_all_hits(rays, ray, hits, s.bounds);
        rows_.append_all(rows, first_ray + ray, hits, std::span<const HitBounds>(s.bounds));
    });
}

template <class Real>
void BlockTracer<Real>::append_any(std::string& rows, Scratch& s) const
{
    const RaysView<Real> rays = s.rays.view();
    s.mask.resize(rays.count);
    scene_.occluded(rays, s.mask.data());
    for (const std::uint8_t hit : s.mask)
        HitRows::append_any(rows, hit);
}

template class BlockTracer<float>;
template class BlockTracer<double>;

}  // namespace packtrace::cli
