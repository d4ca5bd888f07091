#include "cli/block_tracer.hpp"

#include <cstddef>

namespace packtrace::cli {

template <class Real>
BlockTracer<Real>::BlockTracer(const Scene& scene, const RenderOptions& options, RayQuery query)
    : scene_(scene, options), rows_(scene), query_(query)
{
}

template <class Real>
std::string_view BlockTracer<Real>::header() const
{
    switch (query_) {
        case RayQuery::all:
            return HitRows::all_header;
        case RayQuery::any:
            return HitRows::any_header;
        case RayQuery::closest:
            break;
    }
    return HitRows::closest_header;
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
    for (std::size_t i = 0; i < rays.count; ++i) {
        SurfaceHit<Real> hit{s.t[i], s.object[i], {}};
        hit.normal[0] = s.normal_x[i];
        hit.normal[1] = s.normal_y[i];
        hit.normal[2] = s.normal_z[i];
        rows_.append_closest(rows, hit);
    }
}

template <class Real>
void BlockTracer<Real>::append_all(std::string& rows, std::uint64_t first_ray,
                                   const Scratch& s) const
{
    scene_.all_hits(s.rays.view(), [&](std::size_t ray, std::span<const SurfaceHit<Real>> hits) {
        rows_.append_all(rows, first_ray + ray, hits);
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
