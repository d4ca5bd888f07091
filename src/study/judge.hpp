#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "study/wide_truth.hpp"

namespace packtrace::study {

/// What a kernel said of a ray.
struct Answer {
    std::int32_t object = -1;  ///< -1 for a miss
    double t = 0.0;
    Vec3 normal{0.0};
};

/// How often, and how far, a kernel's answers are from the truth.
struct Errors {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    std::uint64_t undecidable = 0;    ///< rays with a meeting inside the band
    std::uint64_t wrong = 0;          ///< another hit or miss than the truth, outside the band
    std::uint64_t wrong_in_band = 0;  ///< the same inside it, where double decides
    std::uint64_t not_finite = 0;     ///< hits with a t or a normal that is no number
    double rho = 0.0;                 ///< worst error of t over what the inputs' rounding makes
    double distance = 0.0;   ///< worst distance of hit points from the surface, in roundoffs
    double normal = 0.0;     ///< worst error of a unit normal
    double relative = 0.0;   ///< worst relative error of t where the condition is below 1000
    double beyond = 0.0;     ///< worst ulp of t where the condition is below 1e8
    std::vector<float> ulp;  ///< errors of t in units of its last place

    void add(const Errors& other);
};

/// Relative changes of the inputs, in roundoffs, within which hit or miss is not held to.
inline constexpr double undecidable_band = 4.0;

/// t may be wrong by its inputs' rounding times this, where hits are told apart by it.
inline constexpr double condition_slack = 4.0;

/// Holds answers against meetings, for kernels whose unit roundoff is `roundoff`.
class Judge {
public:
    Judge(std::span<const WideSurface> surfaces, double roundoff)
        : surfaces_(surfaces), roundoff_(roundoff)
    {
    }

    /// `meetings` are all of the ray, with whatever surface.
    void judge(const StressRay& ray, std::span<const Meeting> meetings, const Answer& answer);

    [[nodiscard]] const Errors& errors() const
    {
        return errors_;
    }

private:
    [[nodiscard]] bool right(std::span<const Meeting> meetings, const Answer& answer,
                             double roundoff) const;
    void measure(const StressRay& ray, const Meeting& meeting, const Answer& answer);

    std::span<const WideSurface> surfaces_;
    double roundoff_;
    Errors errors_;
};

}  // namespace packtrace::study
