#pragma once

#include <packtrace/intersect.hpp>
#include <packtrace/scene.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace packtrace::cli {

/// What to say of each ray: its first hit, all of them in order, or whether there is any.
enum class RayQuery { closest, all, any };

/// Whether hits come with proven bounds of their t.
enum class RayBounds { none, proven };

/// Writes hits as CSV rows, numbers with 17 significant digits, objects by name.
class HitRows {
public:
    static constexpr std::string_view closest_header = "hit,t,object,nx,ny,nz\n";
    static constexpr std::string_view all_header = "ray,t,object,nx,ny,nz\n";
    static constexpr std::string_view any_header = "hit\n";
    static constexpr std::string_view bounded_closest_header =
        "hit,t,object,nx,ny,nz,t_low,t_high\n";
    static constexpr std::string_view bounded_all_header = "ray,t,object,nx,ny,nz,t_low,t_high\n";

    explicit HitRows(const Scene& scene);

    /// Appends a row of `closest_header`, or of `bounded_closest_header` where there are bounds.
    /// These are left empty where they are, and for a miss.
    template <class Real>
    void append_closest(std::string& rows, const SurfaceHit<Real>& hit,
                        const HitBounds* bounds) const;

    /// Appends a row of `all_header` for each hit of the ray of that number, or of
    /// `bounded_all_header` where there are bounds: none, or one a hit.
    template <class Real>
    void append_all(std::string& rows, std::uint64_t ray, std::span<const SurfaceHit<Real>> hits,
                    std::span<const HitBounds> bounds) const;

    /// Appends a row of `any_header`.
    static void append_any(std::string& rows, std::uint8_t hit);

private:
    /// Without the line's end.
    template <class Real>
    void append_hit(std::string& rows, const SurfaceHit<Real>& hit) const;

    std::vector<std::string> names_;  // in quotes where CSV wants them
};

/// The line above all rows.
[[nodiscard]] std::string_view header_of(RayQuery query, RayBounds bounds);

}  // namespace packtrace::cli
