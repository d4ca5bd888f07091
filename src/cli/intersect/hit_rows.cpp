#include "cli/intersect/hit_rows.hpp"

#include "core/text.hpp"

#include <charconv>
#include <cstddef>

namespace packtrace::cli {
namespace {

// RFC 4180: puts text in quotes that would otherwise be read as several fields or lines.
std::string csv_field(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    return '"' + replaced(text, '"', "\"\"") + '"';
}

void append_number(std::string& rows, double value)
{
    char digits[32];  // at most 24 are needed: -1.2345678901234567e-308
    // Adding +0 removes the sign of a zero, because kernels may disagree about it.
    const auto end =
        std::to_chars(digits, digits + sizeof digits, value + 0.0, std::chars_format::general, 17);
    rows.append(digits, end.ptr);
}

/// Appends the two columns of bounds.
void append_bounds(std::string& rows, const HitBounds& bounds)
{
    rows += ',';
    if (!bounds.empty())
        append_number(rows, bounds.low);
    rows += ',';
    if (!bounds.empty())
        append_number(rows, bounds.high);
}

}  // namespace

HitRows::HitRows(const Scene& scene)
{
    for (const Object& object : scene.objects)
        names_.push_back(csv_field(object.name));
}

template <class Real>
void HitRows::append_hit(std::string& rows, const SurfaceHit<Real>& hit) const
{
    append_number(rows, hit.t);
    rows += ',';
    rows += names_[static_cast<std::size_t>(hit.object)];
    for (const Real component : hit.normal) {
        rows += ',';
        append_number(rows, component);
    }
}

template <class Real>
void HitRows::append_closest(std::string& rows, const SurfaceHit<Real>& hit,
                             const HitBounds* bounds) const
{
    rows += hit.object < 0 ? "0,,,,," : "1,";
    if (hit.object >= 0)
        append_hit(rows, hit);
    if (bounds != nullptr)
        append_bounds(rows, *bounds);
    rows += '\n';
}

template <class Real>
void HitRows::append_all(std::string& rows, std::uint64_t ray,
                         std::span<const SurfaceHit<Real>> hits,
                         std::span<const HitBounds> bounds) const
{
    for (std::size_t i = 0; i < hits.size(); ++i) {
        rows += std::to_string(ray);
        rows += ',';
        append_hit(rows, hits[i]);
        if (!bounds.empty())
            append_bounds(rows, bounds[i]);
        rows += '\n';
    }
}

void HitRows::append_any(std::string& rows, std::uint8_t hit)
{
    rows += hit != 0 ? "1\n" : "0\n";
}

template void HitRows::append_closest(std::string&, const SurfaceHit<float>&,
                                      const HitBounds*) const;
template void HitRows::append_closest(std::string&, const SurfaceHit<double>&,
                                      const HitBounds*) const;
template void HitRows::append_all(std::string&, std::uint64_t, std::span<const SurfaceHit<float>>,
                                  std::span<const HitBounds>) const;
template void HitRows::append_all(std::string&, std::uint64_t, std::span<const SurfaceHit<double>>,
                                  std::span<const HitBounds>) const;

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

}  // namespace packtrace::cli
