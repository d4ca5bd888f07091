#pragma once

#include <packtrace/intersect.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace packtrace::cli {

/// The query for each ray: its closest hit, all hits in order, or whether there is any hit.
enum class RayQuery { closest, all, any };

/// Whether hits come with proven bounds of their t.
enum class RayBounds { none, proven };

/// Writes hits as CSV rows, with 17 significant digits and the names of objects.
class HitRows {
public:
    static constexpr std::string_view closest_header = "hit,t,object,nx,ny,nz\n";
    static constexpr std::string_view all_header = "ray,t,object,nx,ny,nz\n";
    static constexpr std::string_view any_header = "hit\n";
    static constexpr std::string_view bounded_closest_header =
        "hit,t,object,nx,ny,nz,t_low,t_high\n";
    static constexpr std::string_view bounded_all_header = "ray,t,object,nx,ny,nz,t_low,t_high\n";

    explicit HitRows(const Scene& scene);

    /// Appends a row of `closest_header`, or of `bounded_closest_header` if there are bounds. The
    /// columns of bounds stay empty for empty bounds and for a miss.
    template <class Real>
    void append_closest(std::string& rows, const SurfaceHit<Real>& hit,
                        const HitBounds* bounds) const;

    /// Appends a row of `all_header` for each hit of the ray with number `ray`, or of
    /// `bounded_all_header` if there are bounds. There must be no bounds, or one for each hit.
    template <class Real>
    void append_all(std::string& rows, std::uint64_t ray, std::span<const SurfaceHit<Real>> hits,
                    std::span<const HitBounds> bounds) const;

    /// Appends a row of `any_header`.
    static void append_any(std::string& rows, std::uint8_t hit);

private:
    /// Appends a hit without the line's end.
    template <class Real>
    void append_hit(std::string& rows, const SurfaceHit<Real>& hit) const;

    std::vector<std::string> names_;  // in quotes if CSV needs them
};

/// The line above all rows.
[[nodiscard]] std::string_view header_of(RayQuery query, RayBounds bounds);

}  // namespace packtrace::cli
