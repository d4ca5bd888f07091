#pragma once

#include "lab/stress/stress_subject.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// Holds answers against the truth.
namespace packtrace::lab {

/// What an answer is, held against the one expected hit.
enum class Verdict {
    right,
    lost,          ///< a miss where there is a hit
    false_hit,     ///< a hit where there is none
    wrong_object,  ///< another object than the first
    wrong_root     ///< another hit of the right object, such as its far side
};

/// Decided alone by what differs by more than `band`. Where the expected hit itself is inside the
/// band, the answer may be any of those that might be right.
[[nodiscard]] Verdict verdict_of(const Expected& expected, const Answer& answer, double band,
                                 double roundoff);

/// How often, and how far, a kernel's answers are from the truth.
struct Errors : ErrorCounts {
    std::vector<float> ulp;     ///< errors of t in units of its last place
    std::vector<float> normal;  ///< largest errors of a component of a unit normal

    /// Wrong decisions of the closest hit.
    [[nodiscard]] std::uint64_t wrong() const
    {
        return lost + false_hits + wrong_object + wrong_root;
    }
    void add(const Errors& other);
};

/// Holds the answers of a kernel with unit roundoff `roundoff` against what is expected.
class Evaluation {
public:
    explicit Evaluation(double roundoff) : roundoff_(roundoff)
    {
    }

    void add(const StressRay& ray, const Expected& expected, const Answer& answer);
    /// What any-hit said of a ray.
    void add_occluded(const Expected& expected, bool occluded);
    /// The first of all hits of a ray, as the object's number, beside its closest hit.
    void add_first_of_all(const Expected& expected, std::int32_t first, std::int32_t closest);
    /// How many hits a ray has that starts inside a closed body.
    void add_crossings(const Expected& expected, std::size_t count);

    [[nodiscard]] const Errors& errors() const
    {
        return errors_;
    }

private:
    void count(Verdict verdict);
    void measure(const StressRay& ray, const Expected& expected, const Answer& answer);

    double roundoff_;
    Errors errors_;
};

// What is wrong with the answers to single rays, in words.

/// Whether the closest hits are the same, bit for bit.
[[nodiscard]] bool same_answers(const StressRun& a, const StressRun& b);

/// The answers to one ray of a scene, held against what is expected.
void evaluate_ray(Evaluation& evaluation, const StressGroup& group, const StressRun& run,
                  std::size_t i);

/// What is wrong with the answers to one ray, in a word or two; empty where nothing is.
[[nodiscard]] const char* fault_of(const Errors& one);

/// Which ray it is, what it should hit, and what was said.
[[nodiscard]] std::string example_text(const StressGroup& group, std::size_t scene, std::size_t ray,
                                       const Answer& answer, const char* fault);

/// A ray as a CSV file that `packtrace intersect` reads.
[[nodiscard]] std::string csv_of(const StressRay& ray);

}  // namespace packtrace::lab
