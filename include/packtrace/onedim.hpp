#pragma once

#include <packtrace/export.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The one-dimensional ray tracer of note 003. An eye looks along a line at n surfaces, and sees
/// the darkest intensity that solves the equations of the line (docs/onedim.md).
namespace packtrace::onedim {

/// From dark to bright.
enum class Intensity : std::uint8_t { none, medium, all };

/// The side a surface faces: towards the eye or away from it.
enum class Direction : std::uint8_t { towards, away };

/// One surface. It takes one byte, because solvers read many surfaces.
struct Surface {
    Direction direction : 1 = Direction::towards;
    Intensity reflectance : 2 = Intensity::none;
    Intensity translucence : 2 = Intensity::none;
    Intensity emission : 2 = Intensity::none;

    bool operator==(const Surface&) const = default;
};

/// Many systems in two arrays. The surfaces of a system are ordered from the eye outwards.
struct Systems {
    std::vector<Surface> surfaces;  ///< of all systems, one after another
    std::vector<std::size_t> ends;  ///< one past each system's last index in `surfaces`; ascending

    [[nodiscard]] std::size_t size() const
    {
        return ends.size();
    }
    [[nodiscard]] std::span<const Surface> operator[](std::size_t k) const
    {
        const std::size_t begin = k == 0 ? 0 : ends[k - 1];
        return {surfaces.data() + begin, ends[k] - begin};
    }
    void push_back(std::span<const Surface> system)
    {
        surfaces.insert(surfaces.end(), system.begin(), system.end());
        ends.push_back(surfaces.size());
    }
    void clear()
    {
        surfaces.clear();
        ends.clear();
    }
};

/// scalar: sweeps over the note's equations until nothing changes. linear: one table look-up per
/// surface. bitsliced: as many systems at once as a SIMD register has bits.
enum class Solver { scalar, linear, bitsliced };

struct SolveOptions {
    Solver solver = Solver::bitsliced;
    std::string isa = "auto";  ///< bitsliced only: see choose_isa()
};

/// The intensity that the eye sees: L0 of the least solution.
[[nodiscard]] PACKTRACE_API Intensity solve(std::span<const Surface> system);

/// L0 of every system, in order. Throws std::invalid_argument if `ends` is not ascending or goes
/// beyond the surfaces, and for an instruction set that is unknown or not supported.
[[nodiscard]] PACKTRACE_API std::vector<Intensity> solve(const Systems& systems,
                                                         const SolveOptions& options = {});

/// `note`: the notation of note 003 (`Inr Inl ()`). `compact`: one letter. `words`: English.
enum class Notation { note, compact, words };

[[nodiscard]] PACKTRACE_API std::string_view to_text(Intensity value, Notation notation);

/// A system on one line, in the note's notation for `note`, otherwise in the compact one.
[[nodiscard]] PACKTRACE_API std::string to_text(std::span<const Surface> system, Notation notation);

/// Why a line is not a system.
struct SyntaxError {
    std::size_t column = 0;  ///< from 1, in bytes
    std::string message;     ///< what was expected and what was found
};

/// Reads the system on `line`, in the note's or the compact notation, and appends it to `systems`.
/// In case of an error, returns it and leaves `systems` unchanged.
[[nodiscard]] PACKTRACE_API std::optional<SyntaxError> read_system(std::string_view line,
                                                                   Systems& systems);

}  // namespace packtrace::onedim
