#pragma once

#include "lab/stress/stress_subject.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// Compares answers with the truth.
namespace packtrace::lab {

/// The result of comparing an answer with the expected hit.
enum class Verdict {
    right,
    lost,          ///< a miss where there is a hit
    false_hit,     ///< a hit where there is none
    wrong_object,  ///< another object than the first
    wrong_root     ///< another hit of the right object, such as its far side
};

/// Compares an answer with the expected hit. If changes of the inputs within `band` change the
/// expected hit, any answer is right that would be right after such a change.
[[nodiscard]] Verdict verdict_of(const Expected& expected, const Answer& answer, double band,
                                 double roundoff);

/// How many of a kernel's answers are wrong, and the sizes of their errors.
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

/// Compares the answers of a kernel with unit roundoff `roundoff` with the expected ones.
class Evaluation {
public:
    explicit Evaluation(double roundoff) : roundoff_(roundoff)
    {
    }

    void add(const StressRay& ray, const Expected& expected, const Answer& answer);
    /// The any-hit answer.
    void add_occluded(const Expected& expected, bool occluded);
    /// The objects of the first of all hits and of the closest hit.
    void add_first_of_all(const Expected& expected, std::int32_t first, std::int32_t closest);
    /// The number of hits; checked for rays that start well inside or outside a closed body.
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

/// Whether the closest hits have the same bits.
[[nodiscard]] bool same_answers(const StressRun& a, const StressRun& b);

/// Adds all answers to ray `i` of a group.
void evaluate_ray(Evaluation& evaluation, const StressGroup& group, const StressRun& run,
                  std::size_t i);

/// The fault of the answers to one ray, in a few words; empty for none.
[[nodiscard]] const char* fault_of(const Errors& one);

/// A sentence with the fault, the ray, the expected hit, and the answer.
[[nodiscard]] std::string example_text(const StressGroup& group, std::size_t scene, std::size_t ray,
                                       const Answer& answer, const char* fault);

/// A ray as a CSV file that `packtrace intersect` reads.
[[nodiscard]] std::string csv_of(const StressRay& ray);

}  // namespace packtrace::lab
